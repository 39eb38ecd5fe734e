#pragma once

#include "core/light/stokes.h"
#include "core/montecarlo/photon_rng.h"
#include "tracer/optics/dielectric_face.h"

namespace evenglow::tracer {

/// Light after it has met a facet, and on which side of it.
struct FacetMeeting {
  core::StokesVector light;
  bool passed = false;  ///< refracted; else reflected
};

/// One meeting with a smooth facet of any tilt, by the odds of this Stokes vector (`face`: the media below and above
/// it along its normal; Fresnel amplitudes, total reflection with its phases). `normal` unit, out of the body;
/// `from_inside`: which side the light is on, which rounding must not decide at grazing incidence.
FacetMeeting meet_facet(const DielectricFace& face, const core::Vec3& normal, const core::StokesVector& light,
                        bool from_inside, core::PhotonRng& rng);

}  // namespace evenglow::tracer
