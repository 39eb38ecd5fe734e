#pragma once

#include <optional>

#include "core/montecarlo/photon_rng.h"
#include "tracer/optics/bsdf.h"

/// Surfaces passed against the light's way, for paths that are built from the viewer.
///
/// Importance: what a viewer gets of light with the Stokes vector s is w . s = w_I I + w_Q Q + w_U U + w_V V, both in
/// one frame (e1, e2, k), k the light's direction of travel. It is written as a StokesVector in that frame. A surface
/// with the Mueller matrix M from k_in to k_out turns the importance at k_out into M^T w at k_in.
namespace evenglow::tracer {

/// The light that would travel the other way and be as an importance is: (I, Q, -U, V) in the frame (e1, -e2, -k). By
/// reciprocity (de Hoop, Appl. Sci. Res. B 8, 1960: the Jones matrix of the reversed path is the transpose, seen in the
/// same transverse axes) the reversed path has the Mueller matrix O M^T O, O = diag(1, 1, -1, 1), between such frames,
/// so what it makes of the reversed light is the reversed M^T w. Its own inverse.
inline core::StokesVector reversed(const core::StokesVector& s) {
  return {s.I, s.Q, -s.U, s.V, {-s.frame.k, s.frame.e1}};
}

/// w . s of two in any frames of one direction.
inline double joined(const core::StokesVector& importance, const core::StokesVector& light) {
  const core::StokesVector s = light.in_frame(importance.frame.e1);
  return importance.I * s.I + importance.Q * s.Q + importance.U * s.U + importance.V * s.V;
}

enum class BackwardPart {
  kAll,
  kSpecular,      ///< what `Bsdf::specular` tells
  kLitFromBelow,  ///< all, where nothing shines on the upper side: of specular films, light from below without a draw
};

/// One step back through a surface, in its own frame: a direction k_in is drawn from which light may come that leaves
/// along `importance.frame.k`, and the importance there is returned, M^T w over the density of k_in in units in which
/// its mean over the draws is the mean of M^T w over all incidences. Empty: no light comes from there.
///
/// Reciprocal, discrete optics (dielectric faces, prism films) are drawn by what they do to the reversed light, with
/// weight 1. Specular films: by their matrices. Scattering films: the reversed sample only proposes k_in, mixed with a
/// share of cosine-distributed directions, and the weight is the forward response over the density, so that tables need
/// not be reciprocal.
std::optional<core::StokesVector> step_back(const Bsdf& surface, const core::StokesVector& importance,
                                            BackwardPart part, core::PhotonRng& rng);

}  // namespace evenglow::tracer
