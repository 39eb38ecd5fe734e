#pragma once

#include <string>

#include "design/report/report.h"

namespace evenglow::design {

/// `report.html`: one file that needs no other and no network, for screen (light and dark) and paper. All text that
/// comes from the user is escaped.
class HtmlWriter final : public ReportWriter {
 public:
  void write(const Report& report, const std::filesystem::path& directory) const override;
  void write(const Comparison& comparison, const std::filesystem::path& directory) const override;
};

std::string report_html(const Report& report);
std::string report_html(const Comparison& comparison);

}  // namespace evenglow::design
