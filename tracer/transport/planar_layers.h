#pragma once

#include <optional>
#include <vector>

#include "tracer/films/diffuser.h"
#include "tracer/transport/planar_plate.h"
#include "tracer/transport/planar_prism.h"

namespace evenglow::tracer {

/// A horizontal surface above or below the plate, or a face of the plate, and the air above it.
struct PlanarLayer {
  enum class Kind {
    kPlate,      ///< a face of the plate: the walk in the plate knows what it does
    kReflector,  ///< the others, where nothing but these optics is met
    kDiffuser,
    kPrism,
    kOther  ///< by `PhotonHistory::interact`
  };
  Kind kind = Kind::kOther;
  int quad = -1;
  double z = 0.0;  ///< mm
  const Bsdf* optics = nullptr;
  int part = 0;
  PlainReflector reflector;
  const Diffuser* diffuser = nullptr;
  std::optional<PlanarPrism> prism;

  bool air_above = false;  ///< to the next layer, where flights that begin and end within these borders meet no other
  double min_x = 0.0, max_x = 0.0, min_y = 0.0, max_y = 0.0;
  bool last = false;  ///< light that goes up from here meets nothing more
};

/// The layers of a scene with a plate at one wavelength, from below, as far as they are horizontal surfaces between
/// which light flies through air: bottom reflector, bottom and top of the plate, films.
class PlanarLayers {
 public:
  PlanarLayers() = default;
  PlanarLayers(const Scene& scene, const PlanarScene& layout, const PlanarPlate& plate, std::size_t band);

  const PlanarLayer& operator[](std::size_t layer) const { return layers_[layer]; }
  std::size_t size() const { return layers_.size(); }
  /// Of the plate's bottom (4) or top (5).
  std::size_t plate_face(int side) const { return faces_[static_cast<std::size_t>(side - 4)]; }

 private:
  void add(const SceneOptics& optics, int quad, double z);
  void set_air(const Box& box);

  std::vector<PlanarLayer> layers_;
  std::array<std::size_t, 2> faces_{};
};

}  // namespace evenglow::tracer
