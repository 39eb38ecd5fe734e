#pragma once

#include <cstddef>
#include <vector>

namespace evenglow::tracer {

/// Integrals over the hemisphere of the bilinear hat functions of a grid of `u` intervals in [0, 1] and `phi` in a turn
/// (outgoing_polar.h): 2 u^3 r^2 du dphi', for an incidence at `sigma` (rad). Index phi' slow, u fast (u + 1 of them).
/// In u exact, in phi' to 1e-9.
std::vector<double> outgoing_weights(std::size_t u, std::size_t phi, double sigma);

}  // namespace evenglow::tracer
