#pragma once

#include <optional>

#include "tracer/films/prism_profile.h"
#include "tracer/optics/bsdf.h"
#include "tracer/optics/dielectric_face.h"

namespace evenglow::tracer {

struct PrismFilmSpec {
  PrismProfile::Shape profile;
  double base = 0.125;             ///< mm, from the flat face to the valleys, >= 0
  double refractive_index = 1.58;  ///< > 1
  double absorption = 0.0;         ///< 1/mm
  double axis = 0.0;               ///< rad: direction of the grooves from +x towards +y
  bool inverted = false;           ///< the prisms face down (turning film)
};

/// What became of light at one meeting with the film.
struct PrismPass {
  std::optional<core::StokesVector> light;  ///< that leaves up or down, same power; empty: absorbed
  int facets = 0;                           ///< meetings with the structured face, from inside and outside
  int base_faces = 0;                       ///< meetings with the flat face, likewise
};

/// Film of straight prisms (brightness enhancement film; inverted: turning film), traced polarized, by analog odds, in
/// its true cross-section: Fresnel's amplitudes at every face (`DielectricFace`), total reflection with its phases,
/// light that leaves one facet and enters the next prism, returns to the flat face and back, with its place kept all
/// the way. Where in a period the light arrives is drawn uniformly. The profile is the same along the groove, so the
/// trace is one of the cross-section with directions in space ("2.5-D").
///
/// Left out: the distance along the film between entrance and exit (mostly a few film thicknesses), coherence between
/// the orders of reflection and diffraction at the pitch. Light that is inside for more than `kMaxEvents` faces counts
/// as absorbed; without absorption no ray of positive measure is caught for ever, as what is caught could not have
/// entered (paths of light can be reversed).
class PrismFilm final : public Bsdf {
 public:
  static constexpr int kMaxEvents = 10000;

  /// `core::Error` outside the ranges of `PrismFilmSpec`.
  explicit PrismFilm(const PrismFilmSpec& spec);

  PrismPass trace(const core::StokesVector& incident, core::PhotonRng& rng) const;

  std::optional<BsdfSample> sample(const core::StokesVector& incident, core::PhotonRng& rng) const override;
  core::StokesVector evaluate(const core::StokesVector& incident, const core::Vec3& k_out) const override;
  bool scatters() const override { return false; }
  bool redirects() const override { return true; }
  Specular specular(const core::Vec3&) const override { return {}; }

  const PrismFilmSpec& spec() const { return spec_; }

 private:
  struct Walk;
  void start(const core::StokesVector& incident, core::PhotonRng& rng, Walk& walk) const;
  void cross_prism(Walk& walk, core::PhotonRng& rng) const;
  void visit_base(Walk& walk, core::PhotonRng& rng) const;
  void cross_groove(Walk& walk, core::PhotonRng& rng) const;
  void meet_facet(const PrismHit& hit, Walk& walk, core::PhotonRng& rng) const;
  core::StokesVector to_film(const core::StokesVector& light) const;
  core::StokesVector from_film(const core::StokesVector& light) const;

  PrismFilmSpec spec_;
  PrismProfile profile_;
  DielectricFace base_;   ///< its normal into the film
  DielectricFace facet_;  ///< its normal out of the film
  double cos_, sin_;      ///< of the axis
  double flip_;           ///< -1: inverted, by half a turn about the grooves
};

}  // namespace evenglow::tracer
