#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/light/stokes.h"
#include "core/montecarlo/photon_rng.h"
#include "tracer/scene/density_field.h"
#include "tracer/scene/scene.h"

namespace evenglow::tracer {

/// A point of a photon's way and the light that leaves it.
struct PathVertex {
  core::Vec3 position;       ///< mm
  core::StokesVector light;  ///< I = 1; direction of travel in light.frame.k
  std::string at;            ///< the part that was met: a name of the energy account; "source", "bulk"
  std::string side;          ///< which way the surface that was met faces: "top" ...; empty: none
  int body = -1;             ///< that the light travels on in, -1: air
};

/// The whole history of one photon.
struct PhotonPath {
  std::vector<PathVertex> vertices;  ///< the first is where it was emitted
  core::Vec3 end;                    ///< mm; where it was absorbed, or left the backlight
  std::string fate;                  ///< "leaves by top", "absorbed by reflectors.bottom", "lost: leaked"
  std::size_t band = 0;              ///< wavelength
  std::size_t events = 0;            ///< interactions, also those beyond the vertices that were kept
};

/// Traces the photon again that has this index in a trace with this key (general path), and keeps its first
/// `most_vertices` points.
PhotonPath record_path(const Scene& scene, const DensityField& density, const core::RandomKey& key,
                       std::uint64_t photon_index, std::size_t most_vertices = 100000);

}  // namespace evenglow::tracer
