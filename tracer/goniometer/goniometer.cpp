#include "tracer/goniometer/goniometer.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/units.h"
#include "tracer/goniometer/goniometer_optics.h"
#include "tracer/goniometer/goniometer_trace.h"

namespace evenglow::tracer {
namespace {

constexpr double kEnoughHits = 20.0;
constexpr double kSame = 1e-9;  // rad

double illuminance(const GoniometerSpec& spec, bool filtered) {
  return spec.illuminance * (filtered ? 0.5 * (spec.filter.k1 + spec.filter.k2) : 1.0);
}

/// Mean over the cone of f cos over the mean of cos, by two ways to f (1/sr).
struct ConeMeans {
  double film = 0.0;
  std::optional<double> table;
  double projected = 0.0;  ///< integral of cos over the cone, sr
};

ConeMeans cone_means(const GoniometerSpec& spec, const GoniometerRow& row) {
  const LuminanceRow& s = row.setting;
  const GoniometerView view(spec, s.psi);
  const core::StokesVector light = view.light(row.kind, s.filtered, s.filter);
  std::optional<BsdfTable::Slice> slice;
  if (spec.data && spec.data->table.has(row.kind)) {
    slice = spec.data->table.slice(row.kind, s.psi, spec.sigma, spec.data->wavelength_nm);
  }
  // The table counts its axes from the film's: power = (S - (x, y) S . q) / 2 with q = (Q, U) turned by psi.
  const double offset = row.kind == ScatterKind::reflection ? spec.offset_reflection : spec.offset_transmission;
  const double sum_k = spec.filter.k1 + spec.filter.k2;
  const double degree = s.filtered && sum_k > 0.0 ? (spec.filter.k1 - spec.filter.k2) / sum_k : 0.0;
  const double turn = 2.0 * (s.filter - offset - s.psi);
  double film = 0.0, table = 0.0, cosines = 0.0;
  for (const ConePoint& point : cone_points(s.theta, spec.acceptance)) {
    const core::Vec3 k = view.direction(row.kind, point.phi, point.theta);
    const double cosine = std::abs(k.z());
    cosines += cosine;
    film += spec.film.surface->evaluate(light, k).I * cosine;
    if (!slice) continue;
    const BsdfTable::Value v = slice->at(point.phi, point.theta);
    table += 0.5 * v.S * (1.0 - degree * (v.x * std::cos(turn) + v.y * std::sin(turn))) * cosine;
  }
  ConeMeans means;
  means.film = film / cosines;
  if (slice) means.table = table / cosines;
  const double detector = std::abs(view.direction(row.kind, 0.0, s.theta).z());
  means.projected = core::kPi * std::pow(std::sin(spec.acceptance), 2) * detector;
  return means;
}

void take_measured(const GoniometerSpec& spec, GoniometerRow& row) {
  row.setting.measured = -1.0;
  for (const LuminanceTable& table : spec.measured) {
    if (table.kind != row.kind) continue;
    for (const LuminanceRow& m : table.rows) {
      if (m.filtered != row.setting.filtered || std::abs(m.psi - row.setting.psi) > kSame ||
          std::abs(m.theta - row.setting.theta) > kSame || std::abs(m.filter - row.setting.filter) > kSame) {
        continue;
      }
      row.setting.measured = m.measured;
      row.setting.published = m.published;
    }
  }
}

std::vector<GoniometerRow> rows_of(const GoniometerSpec& spec) {
  std::vector<GoniometerRow> rows;
  for (const ScatterKind kind : {ScatterKind::reflection, ScatterKind::transmission}) {
    for (const double psi : spec.psi) {
      for (const double theta : spec.theta) {
        for (std::size_t i = 0; i <= spec.filter.angles.size(); ++i) {
          GoniometerRow row;
          row.kind = kind;
          row.setting.psi = psi;
          row.setting.theta = theta;
          row.setting.filtered = i > 0;
          row.setting.filter = i > 0 ? spec.filter.angles[i - 1] : 0.0;
          take_measured(spec, row);
          rows.push_back(row);
        }
      }
    }
  }
  return rows;
}

const DetectorHits& hits_of(const GoniometerSpec& spec, const std::vector<TracedSetting>& settings,
                            const GoniometerRow& row) {
  for (const TracedSetting& setting : settings) {
    if (setting.psi != row.setting.psi || setting.filtered != row.setting.filtered ||
        setting.filter != row.setting.filter) {
      continue;
    }
    const auto kind = std::find(setting.kinds.begin(), setting.kinds.end(), row.kind);
    if (kind == setting.kinds.end()) continue;
    const auto theta = std::find(spec.theta.begin(), spec.theta.end(), row.setting.theta);
    const auto index =
        (kind - setting.kinds.begin()) * static_cast<std::ptrdiff_t>(spec.theta.size()) + (theta - spec.theta.begin());
    return setting.hits[static_cast<std::size_t>(index)];
  }
  throw core::Error("a goniometer row without a trace");
}

void judge(const GoniometerRow& row, GoniometerAgreement& agreement) {
  if (row.expected_hits < kEnoughHits) return;
  agreement.chi_square += row.z * row.z;
  agreement.largest_z = std::max(agreement.largest_z, std::abs(row.z));
  ++agreement.rows;
}

std::optional<double> column_of(const GoniometerRow& row, GoniometerColumn column) {
  switch (column) {
    case GoniometerColumn::published:
      return row.setting.published >= 0.0 ? std::optional(row.setting.published) : std::nullopt;
    case GoniometerColumn::table:
      return row.table;
    case GoniometerColumn::film:
      return row.film;
    case GoniometerColumn::traced:
      return row.traced.value;
  }
  return std::nullopt;
}

}  // namespace

std::size_t traced_settings(const GoniometerSpec& spec) {
  return settings_of(spec).size();
}

std::optional<GoniometerResult> measure(const GoniometerSpec& spec, const GoniometerTrace& trace) {
  core::expects(spec.film.surface != nullptr && spec.film.surface->scatters(),
                "a goniometer looks at a film that scatters");
  GoniometerResult result;
  result.rows = rows_of(spec);
  std::vector<TracedSetting> settings = settings_of(spec);
  const bool traced = trace.photons > 0;
  if (traced && !trace_settings(spec, trace, settings)) return std::nullopt;
  result.photons = trace.photons * settings.size();
  for (GoniometerRow& row : result.rows) {
    const double E = illuminance(spec, row.setting.filtered);
    const ConeMeans means = cone_means(spec, row);
    row.film = E * means.film;
    if (means.table) row.table = E * *means.table;
    if (!traced) continue;
    const DetectorHits& found = hits_of(spec, settings, row);
    const auto photons = static_cast<double>(trace.photons);
    const double luminance = E / (photons * means.projected);  // of one hit
    const double share = means.film * means.projected;
    row.traced = {found.hits * luminance, found.hits_se * luminance};
    row.hits = found.hits;
    row.expected_hits = photons * share;
    row.z = share > 0.0 ? (row.hits - row.expected_hits) / std::sqrt(row.expected_hits * (1.0 - share)) : 0.0;
    judge(row, result.agreement);
  }
  return result;
}

LuminanceMetrics goniometer_metrics(const GoniometerResult& result, GoniometerColumn column,
                                    std::optional<ScatterKind> kind) {
  std::vector<LuminancePair> pairs;
  for (const GoniometerRow& row : result.rows) {
    if (kind && row.kind != *kind) continue;
    const auto value = column_of(row, column);
    if (value && row.setting.measured >= 0.0) pairs.push_back({row.setting.theta, row.setting.measured, *value});
  }
  return luminance_metrics(pairs);
}

double filtered_bsdf(const GoniometerSpec& spec, ScatterKind kind, double psi, double angle, double theta) {
  const GoniometerView view(spec, psi);
  return spec.film.surface->evaluate(view.linear(angle), view.direction(kind, 0.0, theta)).I;
}

}  // namespace evenglow::tracer
