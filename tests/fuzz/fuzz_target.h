#pragma once

#include <string>
#include <string_view>
#include <vector>

/// Readers that are handed files of strangers, each with files to begin from.
namespace evenglow::tests {

struct FuzzTarget {
  std::string name;
  std::vector<std::string> seeds;  ///< good files, or nearly so
  /// Reads the bytes; core::Error is the answer to wrong input, everything else that is thrown is a finding.
  void (*read)(std::string_view bytes);
};

/// All targets: run_file, film_table_csv, film_table_hdf5, readings_csv, ies, eulumdat, intensity_csv, tm25, zemax,
/// checkpoint, tolerance_state, batch_json, dots_csv, dots_dxf.
const std::vector<FuzzTarget>& fuzz_targets();

}  // namespace evenglow::tests
