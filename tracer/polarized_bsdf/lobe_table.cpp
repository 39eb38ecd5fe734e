#include "tracer/polarized_bsdf/lobe_table.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "core/base/units.h"
#include "tracer/polarized_bsdf/incidence_grid.h"
#include "tracer/polarized_bsdf/pass_axis.h"

namespace evenglow::tracer {
namespace {

constexpr double kLeast = 1e-30;  ///< 1/sr
constexpr double kWavelength = 550.0;
const char* const kName = "lobe model";

BsdfTable::Axes table_axes() {
  BsdfTable::Axes axes;
  const IncidenceGrid grid;
  axes.sigma = grid.sigmas();
  for (std::size_t i = 0; i < IncidenceGrid::kPsi; ++i) {
    axes.psi.push_back(core::kPi * static_cast<double>(i) / static_cast<double>(IncidenceGrid::kPsi));
  }
  for (int i = 0; i < 24; ++i) axes.phi.push_back(15.0 * i * core::kRadPerDeg);
  for (int i = 0; i <= 16; ++i) axes.theta.push_back(i * core::kRadPerDeg);
  for (const double degrees : {18, 20, 22, 24, 26, 28, 30, 33, 36, 40, 44, 48, 52, 56, 60, 65, 70, 75, 80, 85}) {
    axes.theta.push_back(degrees * core::kRadPerDeg);
  }
  axes.lambda_nm = {kWavelength};
  return axes;
}

/// theta of the horizon in the plane phi: cos theta cos sigma = sin theta cos phi sin sigma.
double horizon(double sigma, double phi) {
  return std::atan2(std::cos(sigma), std::cos(phi) * std::sin(sigma));
}

/// One ray of nodes (fixed phi).
class Ray {
 public:
  Ray(const LobeModel& model, ScatterKind kind, double psi, double sigma, double phi, const std::vector<double>& theta)
      : model_(model), kind_(kind), psi_(psi), sigma_(sigma), phi_(phi), theta_(theta) {}

  std::vector<LobeModel::Value> nodes() const {
    // A hair above the horizon, where c is still that of the film.
    const double edge = horizon(sigma_, phi_) * (1.0 - 1e-6);
    std::vector<LobeModel::Value> values;
    std::size_t last = 0;
    for (std::size_t t = 0; t < theta_.size(); ++t) {
      if (theta_[t] < edge) {
        values.push_back(at(theta_[t]));
        last = t;
        continue;
      }
      const double from = theta_[last], share = edge > from ? (theta_[t] - from) / (edge - from) : 1.0;
      const LobeModel::Value a = values[last], b = at(edge);
      values.push_back({continued(a.pass, b.pass, share), continued(a.block, b.block, share)});
    }
    return values;
  }

 private:
  LobeModel::Value at(double theta) const {
    const LobeModel::Value v = model_.at(kind_, psi_, sigma_, phi_, theta);
    return {std::max(v.pass, kLeast), std::max(v.block, kLeast)};
  }

  static double continued(double a, double b, double share) {
    const double log = std::log(a) + std::min(share, 50.0) * (std::log(b) - std::log(a));
    return std::exp(std::clamp(log, std::log(kLeast), std::log(std::max(a, b))));
  }

  const LobeModel& model_;
  ScatterKind kind_;
  double psi_, sigma_, phi_;
  const std::vector<double>& theta_;
};

/// delta of the tau_min axis: the pass axis that the ray sees (reflection) or the block axis, minus psi; 90 degrees on
/// where the two have changed places.
BsdfTable::Node node_of(const LobeModel::Value& v, ScatterKind kind, double psi, double sigma, double n) {
  const AxisAngle axis = pass_axis(std::cos(psi), std::sin(psi), std::sin(sigma), n);
  double delta = 0.5 * std::atan2(axis.sin2, axis.cos2) - psi;
  if (kind == ScatterKind::transmission) delta += 0.5 * core::kPi;
  const bool expected = (v.pass <= v.block) == (kind == ScatterKind::reflection);
  if (!expected) delta += 0.5 * core::kPi;
  BsdfTable::Node node;
  node.tau_min = std::min(v.pass, v.block);
  node.tau_max = std::max(v.pass, v.block);
  node.delta = delta;
  return node;
}

}  // namespace

BsdfTable lobe_table(const LobeModel& model) {
  const BsdfTable::Axes axes = table_axes();
  const double n = model.parameters().refractive_index;
  std::array<std::vector<BsdfTable::Node>, 2> nodes;
  for (const ScatterKind kind : {ScatterKind::reflection, ScatterKind::transmission}) {
    auto& rows = nodes[static_cast<std::size_t>(kind)];
    for (const double psi : axes.psi) {
      for (const double sigma : axes.sigma) {
        std::vector<std::vector<LobeModel::Value>> rays;
        rays.reserve(axes.phi.size());
        for (const double phi : axes.phi) rays.push_back(Ray(model, kind, psi, sigma, phi, axes.theta).nodes());
        for (std::size_t t = 0; t < axes.theta.size(); ++t) {
          for (const auto& ray : rays) rows.push_back(node_of(ray[t], kind, psi, sigma, n));
        }
      }
    }
  }
  return BsdfTable::from_nodes(kName, axes, std::move(nodes));
}

HemisphericalTable lobe_hemispherical(const LobeModel& model) {
  std::string text = "sigma_deg,transmittance_pass,reflectance_pass,transmittance_block,reflectance_block\n";
  for (int degrees = 0; degrees <= 90; ++degrees) {
    const double sigma = degrees * core::kRadPerDeg;
    const auto rho = [&](ScatterKind kind, FilmLight light) {
      return std::max(0.0, model.hemispherical(kind, light, sigma));
    };
    text += fmt::format("{},{},{},{},{}\n", degrees, rho(ScatterKind::transmission, FilmLight::pass),
                        rho(ScatterKind::reflection, FilmLight::pass), rho(ScatterKind::transmission, FilmLight::block),
                        rho(ScatterKind::reflection, FilmLight::block));
  }
  return HemisphericalTable::parse(text, kName);
}

}  // namespace evenglow::tracer
