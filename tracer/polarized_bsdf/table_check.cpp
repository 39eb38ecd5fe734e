#include "tracer/polarized_bsdf/table_check.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/units.h"
#include "core/config/csv_numbers.h"
#include "tracer/polarized_bsdf/bsdf_grid.h"
#include "tracer/polarized_bsdf/csv_units.h"
#include "tracer/polarized_bsdf/grid_check.h"
#include "tracer/polarized_bsdf/hdf5_reader.h"
#include "tracer/polarized_bsdf/hdf5_table.h"
#include "tracer/polarized_bsdf/mueller_check.h"
#include "tracer/polarized_bsdf/mueller_energy.h"
#include "tracer/polarized_bsdf/sampled_bsdf.h"
#include "tracer/polarized_bsdf/sampled_mueller.h"
#include "tracer/polarized_bsdf/stored_table.h"
#include "tracer/polarized_bsdf/table_limits.h"
#include "tracer/polarized_bsdf/table_symmetry.h"

namespace evenglow::tracer {
namespace {

constexpr double kWorstRatio = 10.0;        ///< of S and its reciprocal partner
constexpr double kNotableAsymmetry = 0.01;  ///< mean difference of mirrored nodes

const char* kind_name(ScatterKind kind) {
  return kind == ScatterKind::reflection ? "BRDF" : "BTDF";
}

/// Is there anything, and no control character but tabs and ends of lines?
bool holds_text(std::string_view text) {
  return !text.empty() && std::ranges::none_of(text, [](char c) {
    const auto u = static_cast<unsigned char>(c);
    return u < 0x20 && c != '\t' && c != '\r' && c != '\n';
  });
}

class Checker {
 public:
  Checker(std::string_view text, const std::string& name, const TableCheckOptions& options)
      : text_(text), name_(name), options_(options) {}

  TableCheck run() {
    try {
      if (names_hdf5(name_)) {
        result_.readable = false;
        const Hdf5Reader opened(text_, name_);
        result_.readable = true;
        const StoredTable table = parse_hdf5_table(text_, name_);
        check_table(table.rows(), table);
      } else {
        check_csv();
      }
    } catch (const core::ConfigError& error) {
      result_.faults.insert(result_.faults.end(), error.faults().begin(), error.faults().end());
    }
    return std::move(result_);
  }

 private:
  void remark(std::string text) { result_.remarks.push_back(name_ + ": " + std::move(text)); }

  void fault(int line, std::string message) {
    result_.faults.push_back({name_, line, line > 0 ? 1 : 0, {}, std::move(message)});
  }

  void check_csv() {
    result_.readable = holds_text(text_);
    if (const auto fault = unit_fault(text_, name_, true)) result_.faults.push_back(*fault);
    const StoredForm form = is_mueller_file(text_) ? StoredForm::mueller : StoredForm::diattenuator;
    const core::CsvNumbers rows = core::CsvNumbers::parse(text_, name_, columns_of(form), row_check_of(form));
    std::vector<core::Fault> faults = grid_faults(rows);
    const bool whole = faults.empty();
    std::ranges::move(faults, std::back_inserter(result_.faults));
    // Where the units are others the values say nothing.
    if (whole && !unit_fault(text_, name_, false)) check_table(rows, parse_csv_table(text_, name_));
    if (!text_.empty() && text_.back() != '\n') remark("the last line has no end: is the file whole?");
  }

  void check_table(const core::CsvNumbers& rows, const StoredTable& stored) {
    order_ = sort_to_grid(rows).order;
    const auto totals = [&](double lambda) -> std::optional<HemisphericalTable> {
      if (options_.hemispherical == nullptr) return std::nullopt;
      return options_.hemispherical->at_wavelength(lambda);
    };
    if (stored.form == StoredForm::mueller) {
      const MuellerTable table(stored);
      check_values(rows, table.intensities(), mueller_energies(table, options_.pass_index));
      add_sampler_remarks(table.axes().lambda_nm, [&](double lambda) {
        const auto h = totals(lambda);
        return SampledMueller(table, lambda, h ? &*h : nullptr, options_.pass_index).remarks();
      });
    } else {
      const BsdfTable table = BsdfTable::from_stored(stored);
      check_values(rows, table, incidence_energies(table, options_.pass_index));
      add_sampler_remarks(table.axes().lambda_nm, [&](double lambda) {
        const auto h = totals(lambda);
        return SampledBsdf(table, lambda, h ? &*h : nullptr, options_.pass_index).remarks();
      });
    }
  }

  template <typename Remarks>
  void add_sampler_remarks(const std::vector<double>& wavelengths, const Remarks& remarks) {
    if (!result_.faults.empty()) return;
    for (const double lambda : wavelengths) {
      for (const std::string& text : remarks(lambda)) {
        result_.remarks.push_back(fmt::format("{} ({} nm)", text, lambda));
      }
    }
  }

  void check_values(const core::CsvNumbers& rows, const BsdfTable& table,
                    const std::vector<IncidenceEnergy>& energies) {
    if (is_black(table)) return fault(0, "must reflect or transmit, tau is 0 everywhere");
    collect(table, energies);
    for (const IncidenceEnergy& e : energies) check_energy(rows, table, e);
    check_axes(table, energies);
    for (const ScatterKind kind : {ScatterKind::reflection, ScatterKind::transmission}) {
      if (!table.has(kind)) {
        remark(fmt::format("no {} rows: the film has none", kind_name(kind)));
        continue;
      }
      check_reciprocity(rows, table, kind);
      const Agreement mirrored = mirror_symmetry(table, kind);
      if (mirrored.mean_difference > kNotableAsymmetry) {
        remark(fmt::format("{}: S differs by {:.1f} % on average from S mirrored in psi and phi", kind_name(kind),
                           100.0 * mirrored.mean_difference));
      }
    }
  }

  void collect(const BsdfTable& table, const std::vector<IncidenceEnergy>& energies) {
    const BsdfTable::Axes& axes = table.axes();
    const auto share = 1.0 / static_cast<double>(axes.psi.size());
    for (const double lambda : axes.lambda_nm) {
      for (const double sigma : axes.sigma) result_.hemispherical.push_back({lambda, sigma});
    }
    for (const IncidenceEnergy& e : energies) {
      HemisphericalLine& line = result_.hemispherical[e.lambda * axes.sigma.size() + e.sigma];
      line.reflectance_pass += share * e.reflectance_pass;
      line.transmittance_pass += share * e.transmittance_pass;
      line.reflectance_block += share * e.reflectance_block;
      line.transmittance_block += share * e.transmittance_block;
      line.greatest = std::max(line.greatest, e.greatest);
    }
  }

  std::string incidence_text(const BsdfTable& table, const IncidenceEnergy& e) const {
    return fmt::format("psi {:.6g} sigma {:.6g} lambda {}", table.axes().psi[e.psi] / core::kRadPerDeg,
                       table.axes().sigma[e.sigma] / core::kRadPerDeg, table.axes().lambda_nm[e.lambda]);
  }

  void check_energy(const core::CsvNumbers& rows, const BsdfTable& table, const IncidenceEnergy& e) {
    const std::string where = incidence_text(table, e);
    const int line = line_of(rows, table, kind_with_most(table), e.psi, e.sigma, 0, 0, e.lambda);
    if (options_.hemispherical != nullptr) {
      const HemisphericalTable::Row h =
          options_.hemispherical->at_wavelength(table.axes().lambda_nm[e.lambda]).at(table.axes().sigma[e.sigma]);
      const double pass = (h.reflectance_pass + h.transmittance_pass) / (e.reflectance_pass + e.transmittance_pass);
      const double block =
          (h.reflectance_block + h.transmittance_block) / (e.reflectance_block + e.transmittance_block);
      for (const auto& [factor, axis] : {std::pair{pass, "pass"}, std::pair{block, "block"}}) {
        if (factor >= 1.0 / options_.largest_factor && factor <= options_.largest_factor) continue;
        fault(line, fmt::format("R + T of {} light must agree with the hemispherical table within a factor of {}, got "
                                "one that needs {:.3g} at {}",
                                axis, options_.largest_factor, factor, where));
      }
      return;
    }
    const double limit = 1.0 + options_.energy_tolerance;
    if (!(e.greatest <= limit)) {
      fault(line, fmt::format("R + T of any polarization must be at most 1 (tolerance {}), got {:.4f} at {}",
                              options_.energy_tolerance, e.greatest, where));
    } else if (e.greatest > 1.0) {
      remark(fmt::format("R + T is {:.4f} at {}, within the tolerance of interpolation", e.greatest, where));
    }
  }

  static ScatterKind kind_with_most(const BsdfTable& table) {
    return table.has(ScatterKind::reflection) ? ScatterKind::reflection : ScatterKind::transmission;
  }

  void check_axes(const BsdfTable& table, const std::vector<IncidenceEnergy>& energies) {
    double transmission = 0.0, reflection = 0.0;
    for (const IncidenceEnergy& e : energies) {
      transmission += e.transmittance_pass - e.transmittance_block;
      reflection += e.reflectance_block - e.reflectance_pass;
    }
    if (table.has(ScatterKind::transmission) && transmission < 0.0) {
      remark("pass light is transmitted less than block light: is delta in degrees, and counted from the pass axis?");
    }
    if (table.has(ScatterKind::reflection) && reflection < 0.0) {
      remark("pass light is reflected more than block light: is delta in degrees, and counted from the pass axis?");
    }
  }

  void check_reciprocity(const core::CsvNumbers& rows, const BsdfTable& table, ScatterKind kind) {
    const Agreement found = reciprocity(table, kind);
    const NodeComparison& w = found.worst;
    const int line = line_of(rows, table, kind, w.psi, w.sigma, w.phi, w.theta, w.lambda);
    const double ratio = std::max(w.ratio, 1.0 / w.ratio);
    const std::string where = line > 0 ? "here" : node_text(table, w);
    if (found.mean_difference > options_.reciprocity_tolerance) {
      fault(line, fmt::format("{} must be reciprocal within {} on average (weighted by projected solid angle), got "
                              "{:.3f} over {} pairs; worst {}, a factor of {:.3g}",
                              kind_name(kind), options_.reciprocity_tolerance, found.mean_difference, found.pairs,
                              where, ratio));
    } else if (ratio > kWorstRatio) {
      fault(line, fmt::format("{} must be within a factor of {} of the reversed path, got {:.3g} {}", kind_name(kind),
                              kWorstRatio, ratio, where));
    }
  }

  static std::string node_text(const BsdfTable& table, const NodeComparison& w) {
    const BsdfTable::Axes& a = table.axes();
    return fmt::format("at psi {:.6g} sigma {:.6g} phi {:.6g} theta {:.6g} lambda {}", a.psi[w.psi] / core::kRadPerDeg,
                       a.sigma[w.sigma] / core::kRadPerDeg, a.phi[w.phi] / core::kRadPerDeg,
                       a.theta[w.theta] / core::kRadPerDeg, a.lambda_nm[w.lambda]);
  }

  /// Line of a node: rows sorted to the grid are kind, lambda, psi, sigma, theta, phi.
  int line_of(const core::CsvNumbers& rows, const BsdfTable& table, ScatterKind kind, std::size_t psi,
              std::size_t sigma, std::size_t phi, std::size_t theta, std::size_t lambda) const {
    const BsdfTable::Axes& a = table.axes();
    const bool second = kind == ScatterKind::transmission && table.has(ScatterKind::reflection);
    std::size_t index = (second ? a.lambda_nm.size() : 0) + lambda;
    index = (index * a.psi.size() + psi) * a.sigma.size() + sigma;
    index = (index * a.theta.size() + theta) * a.phi.size() + phi;
    return rows.line(order_.at(index));
  }

  std::string_view text_;
  const std::string& name_;
  const TableCheckOptions& options_;
  std::vector<std::size_t> order_;
  TableCheck result_;
};

}  // namespace

TableCheck check_table(std::string_view text, const std::string& name, const TableCheckOptions& options) {
  return Checker(text, name, options).run();
}

}  // namespace evenglow::tracer
