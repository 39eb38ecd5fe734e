#pragma once

#include <cmath>
#include <functional>
#include <string>

#include "core/base/units.h"
#include "core/light/mueller.h"
#include "tracer/films/dbef.h"
#include "tracer/polarized_bsdf/mueller_columns.h"
#include "tracer/polarized_bsdf/mueller_table.h"
#include "tracer/polarized_bsdf/pass_axis.h"
#include "tracer/polarized_bsdf/stored_table.h"

namespace evenglow::tests {

/// Indices of a node: kind (ScatterKind), psi, sigma, phi, theta, lambda.
using NodeIndex = std::array<std::size_t, 6>;

/// A table of Mueller matrices, filled by `matrix` (1/sr) of the node's indices.
inline tracer::StoredTable mueller_stored(const std::string& name, std::vector<std::size_t> kinds,
                                          std::array<std::vector<double>, 5> axes,
                                          const std::function<core::MuellerMatrix(const NodeIndex&)>& matrix) {
  tracer::StoredTable table;
  table.name = name;
  table.form = tracer::StoredForm::mueller;
  table.comment = tracer::default_comment(table.form);
  table.kinds = std::move(kinds);
  table.axes = std::move(axes);
  table.values.resize(tracer::mueller_columns().size() - tracer::kFirstEntry);
  const auto& a = table.axes;
  for (const std::size_t kind : table.kinds) {
    for (std::size_t p = 0; p < a[0].size(); ++p) {
      for (std::size_t s = 0; s < a[1].size(); ++s) {
        for (std::size_t f = 0; f < a[2].size(); ++f) {
          for (std::size_t t = 0; t < a[3].size(); ++t) {
            for (std::size_t l = 0; l < a[4].size(); ++l) {
              const core::MuellerMatrix M = matrix({kind, p, s, f, t, l});
              for (int e = 0; e < 16; ++e) table.values[static_cast<std::size_t>(e)].push_back(M(e / 4, e % 4));
            }
          }
        }
      }
    }
  }
  return table;
}

/// The matrices that a film of kind `dbef` means by its table: R(-chi_o) D R(delta + psi), counted from e1 of the rays
/// (`laboratory`) or from the film's axis.
inline tracer::StoredTable mueller_of(const tracer::BsdfTable& table, bool laboratory) {
  const auto& a = table.axes();
  const auto degrees = [](std::vector<double> angles) {
    for (double& angle : angles) angle /= core::kRadPerDeg;
    return angles;
  };
  auto stored = mueller_stored(
      "dbef.mueller.csv", {0, 1}, {degrees(a.psi), degrees(a.sigma), degrees(a.phi), degrees(a.theta), a.lambda_nm},
      [&](const NodeIndex& i) -> core::MuellerMatrix {
        const auto kind = static_cast<tracer::ScatterKind>(i[0]);
        const auto& node = table.node(kind, i[1], i[2], i[3], i[4], i[5]);
        const double psi = a.psi[i[1]], sigma = a.sigma[i[2]], phi = a.phi[i[3]], theta = a.theta[i[4]];
        const double turned = tracer::outgoing_psi(psi, sigma, phi, theta);
        const double x = std::cos(theta) * std::sin(sigma) + std::sin(theta) * std::cos(phi) * std::cos(sigma);
        const double y = std::sin(theta) * std::sin(phi);
        const auto chi =
            tracer::pass_axis(std::cos(turned), std::sin(turned), std::min(1.0, std::hypot(x, y)), tracer::kDbefIndex);
        double out = 0.5 * std::atan2(chi.sin2, chi.cos2);
        if (kind == tracer::ScatterKind::transmission) out += core::kPi / 2;
        // tau_min along the axis at delta + psi comes first in D.
        const core::MuellerMatrix lab = core::rotator(-out) *
                                        core::diattenuator(node.tau_min, node.tau_max, node.kappa) *
                                        core::rotator(node.delta + psi);
        if (laboratory) return lab;
        return core::rotator(turned) * lab * core::rotator(-psi);
      });
  stored.comment += laboratory ? ", frames e1, e2 of the incident and of the outgoing ray"
                               : ", frames turned to the film axis in both channels";
  return stored;
}

}  // namespace evenglow::tests
