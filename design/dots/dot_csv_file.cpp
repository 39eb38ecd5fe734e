#include <fmt/format.h>

#include "core/base/units.h"
#include "core/config/message_text.h"
#include "core/dots/dot_csv.h"
#include "design/dots/dot_files.h"
#include "design/dots/streamed_file.h"

namespace evenglow::design {
namespace {

constexpr std::size_t kFlush = 1 << 16;

}  // namespace

void write_dot_csv(const DotSheet& sheet, const std::filesystem::path& path) {
  StreamedFile file(path);
  fmt::memory_buffer text;
  fmt::format_to(
      fmt::appender(text), "# {}; {} dots, {}; x and y of the center (mm), diameter{} (um), axis (degrees)\n{}\n",
      core::one_line(sheet.title), sheet.dots.size(), sheet.footprint == core::Footprint::round ? "round" : "square",
      sheet.footprint == core::Footprint::round ? "" : " = width", core::kDotColumns);
  for (const core::Dot& dot : sheet.dots) {
    fmt::format_to(fmt::appender(text), "{:.6f},{:.6f},{:.7g},{:.6g}\n", dot.x, dot.y,
                   2.0 * static_cast<double>(dot.radius) / core::kMmPerUm,
                   static_cast<double>(dot.angle) / core::kRadPerDeg);
    if (text.size() < kFlush) continue;
    file.write({text.data(), text.size()});
    text.clear();
  }
  file.write({text.data(), text.size()});
  file.finish();
}

}  // namespace evenglow::design
