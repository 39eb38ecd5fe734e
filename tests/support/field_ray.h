#pragma once

#include <complex>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/light/stokes.h"
#include "core/montecarlo/photon_rng.h"

/// Light as a complex field vector in space: an independent way to trace polarization.
namespace evenglow::tests {

/// Light as a field.
struct FieldRay {
  Eigen::Vector3d k;
  Eigen::Vector3cd field;
};

/// One of the fields that make up this light, which must be unpolarized or fully polarized.
FieldRay field_of(const core::StokesVector& light, core::PhotonRng& rng);
core::StokesVector stokes_of(const FieldRay& ray);

/// A smooth facet between `n_in` (behind it) and `n_out` (`outward` of it): the field is bent or reflected by its odds.
/// `inside` tells where it is, before and after.
void meet_facet(FieldRay& ray, const Eigen::Vector3d& outward, double n_in, double n_out, bool& inside,
                core::PhotonRng& rng);

}  // namespace evenglow::tests
