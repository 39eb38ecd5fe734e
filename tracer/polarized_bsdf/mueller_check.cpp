#include "tracer/polarized_bsdf/mueller_check.h"

#include <algorithm>

#include "core/config/csv_numbers.h"
#include "tracer/polarized_bsdf/csv_units.h"
#include "tracer/polarized_bsdf/mueller_columns.h"

namespace evenglow::tracer {

bool is_mueller_file(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    if (!line.starts_with('#') && line.find_first_not_of(" \t\r") != std::string_view::npos) {
      return line.find("m00") != std::string_view::npos;
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return false;
}

std::vector<core::Fault> mueller_faults(std::string_view text, const std::string& name) {
  std::vector<core::Fault> faults;
  if (const auto fault = unit_fault(text, name, true)) faults.push_back(*fault);
  try {
    core::CsvNumbers::parse(text, name, mueller_columns(), mueller_row_fault);
  } catch (const core::ConfigError& error) {
    faults.insert(faults.end(), error.faults().begin(), error.faults().end());
  }
  return faults;
}

}  // namespace evenglow::tracer
