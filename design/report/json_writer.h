#pragma once

#include <string>

#include "design/report/report.h"

namespace evenglow::design {

/// `result.json` and `compare.json`, with the keys of the interface description. The same results give the same bytes:
/// fixed order of keys, shortest numbers that read back as they were, `null` for what is not a number. Only `timing`,
/// `threads` and `ranks` tell of the machine; so the seconds of a step stand in `timing.steps`
/// (`step`, `cpu_s`, `wall_s`), not in `steps`; convergence.csv has them beside the other columns.
class JsonWriter final : public ReportWriter {
 public:
  void write(const Report& report, const std::filesystem::path& directory) const override;
  void write(const Comparison& comparison, const std::filesystem::path& directory) const override;
};

/// Content of `result.json`.
std::string result_json(const Report& report);
/// Content of `compare.json`; holds nothing that depends on the machine.
std::string comparison_json(const Comparison& comparison);

}  // namespace evenglow::design
