#include "design/report/writer_registry.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <system_error>

#include "core/base/error.h"
#include "design/report/csv_writer.h"
#include "design/report/hdf5_map_writer.h"
#include "design/report/html_writer.h"
#include "design/report/json_writer.h"
#include "design/report/png_writer.h"
#include "design/report/vti_writer.h"

namespace evenglow::design {
namespace {

struct Format {
  std::string name;
  bool by_default = true;  ///< or only when asked for
  std::function<std::unique_ptr<const ReportWriter>()> make;
};

/// One line for each format.
std::vector<Format> formats_known() {
  return {
      {"json", true, [] { return std::make_unique<const JsonWriter>(); }},
      {"csv", true, [] { return std::make_unique<const CsvWriter>(); }},
      {"png", true, [] { return std::make_unique<const PngWriter>(); }},
      {"html", true, [] { return std::make_unique<const HtmlWriter>(); }},
      {"vti", false, [] { return std::make_unique<const VtiWriter>(); }},
      {"hdf5", false, [] { return std::make_unique<const Hdf5MapWriter>(); }},
  };
}

template <typename Result>
void write_all(const Result& result, const std::vector<std::string>& names, const std::filesystem::path& directory) {
  std::error_code failure;
  std::filesystem::create_directories(directory, failure);
  if (failure) throw core::Error("cannot make the directory " + directory.string() + ": " + failure.message());
  const std::vector<Format> known = formats_known();
  for (const std::string& name : names) {
    const auto format = std::find_if(known.begin(), known.end(), [&](const Format& f) { return f.name == name; });
    core::expects(format != known.end(), "a format of the registry, got " + name);
    format->make()->write(result, directory);
  }
}

}  // namespace

std::vector<std::string> output_formats() {
  std::vector<std::string> names;
  for (const Format& format : formats_known()) names.push_back(format.name);
  return names;
}

std::vector<std::string> default_output_formats() {
  std::vector<std::string> names;
  for (const Format& format : formats_known()) {
    if (format.by_default) names.push_back(format.name);
  }
  return names;
}

void write_report(const Report& report, const std::vector<std::string>& formats,
                  const std::filesystem::path& directory) {
  write_all(report, formats, directory);
}

void write_report(const Comparison& comparison, const std::vector<std::string>& formats,
                  const std::filesystem::path& directory) {
  write_all(comparison, formats, directory);
}

}  // namespace evenglow::design
