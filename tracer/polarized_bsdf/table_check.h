#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "tracer/polarized_bsdf/hemispherical_table.h"
#include "tracer/polarized_bsdf/table_energy.h"

namespace evenglow::tracer {

struct TableCheckOptions {
  double energy_tolerance = 0.02;       ///< R + T above 1 by more is a fault, by less a remark
  double reciprocity_tolerance = 0.10;  ///< weighted mean difference of S, relative
  double pass_index = 1.58;             ///< see pass_axis.h
  /// What the table will be normalized to. Then R + T of the table itself is judged by the factor that it needs: a
  /// fault beyond `largest_factor` or below its inverse.
  const HemisphericalTable* hemispherical = nullptr;
  double largest_factor = 1.25;
};

/// Hemispherical values of one incidence, mean over the psi nodes.
struct HemisphericalLine {
  double lambda_nm = 0.0, sigma = 0.0;  ///< nm, rad
  double reflectance_pass = 0.0, transmittance_pass = 0.0;
  double reflectance_block = 0.0, transmittance_block = 0.0;
  double greatest = 0.0;  ///< R + T, over psi and all polarizations
};

struct TableCheck {
  bool readable = true;             ///< false: no text (empty, binary), or no HDF5 file that opens
  std::vector<core::Fault> faults;  ///< one line each; empty: the table is good
  std::vector<std::string> remarks;
  std::vector<HemisphericalLine> hemispherical;  ///< lambda slowest; empty if the table could not be read
};

/// Is a BSDF table physical and whole? Faults: what `core::CsvNumbers` and `BsdfTable` refuse (so 0 <= tau_min <=
/// tau_max, 0
/// <= kappa <= 1, which is the same as a coherency matrix without negative eigenvalue: those of this form are 0, 0 and
/// (t+ +- sqrt(t-^2 + 4 c^2)) / 4), units, repeated and missing nodes, rows out of order, energy, tau 0 everywhere,
/// reciprocity beyond the tolerance or beyond a factor of 10 anywhere. Remarks: energy within the tolerance, mirror
/// symmetry, pass and block axis exchanged, what the sampler will do.
///
/// A table of Mueller matrices (column m00) passes the same checks with its own forms: least eigenvalue of each
/// coherency matrix at least -1e-6 of its trace; R + T of the polarization that has most over the whole Poincare
/// sphere; reciprocity and mirror symmetry of m00.
///
/// A name that ends in .h5 or .hdf5 makes `text` the bytes of an HDF5 file (`parse_hdf5_table`).
TableCheck check_table(std::string_view text, const std::string& name, const TableCheckOptions& options = {});

}  // namespace evenglow::tracer
