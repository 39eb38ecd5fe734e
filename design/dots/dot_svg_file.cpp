#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/units.h"
#include "design/dots/dot_files.h"
#include "design/dots/streamed_file.h"

namespace evenglow::design {
namespace {

constexpr std::size_t kFlush = 1 << 16;

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (static_cast<unsigned char>(c) >= 0x20)
      result += c;
  }
  return result;
}

/// A part of the plate in its middle, of its proportions, that holds about `most` dots if they are spread evenly.
RectangleZone middle(const RectangleZone& plate, double share) {
  const double part = 0.5 * std::sqrt(share);
  const double x = 0.5 * (plate.x0 + plate.x1), y = 0.5 * (plate.y0 + plate.y1);
  return {x - part * (plate.x1 - plate.x0), x + part * (plate.x1 - plate.x0), y - part * (plate.y1 - plate.y0),
          y + part * (plate.y1 - plate.y0)};
}

void add_dot(const core::Dot& dot, core::Footprint footprint, fmt::memory_buffer& text) {
  const double r = static_cast<double>(dot.radius);
  if (footprint == core::Footprint::round) {
    fmt::format_to(fmt::appender(text), "<circle cx=\"{:.4f}\" cy=\"{:.4f}\" r=\"{:.5g}\"/>\n", dot.x, dot.y, r);
    return;
  }
  fmt::format_to(
      fmt::appender(text),
      "<rect x=\"{:.5g}\" y=\"{:.5g}\" width=\"{:.5g}\" height=\"{:.5g}\" transform=\"translate({:.4f} {:.4f}) "
      "rotate({:.5g})\"/>\n",
      -r, -r, 2.0 * r, 2.0 * r, dot.x, dot.y, static_cast<double>(dot.angle) / core::kRadPerDeg);
}

}  // namespace

void write_dot_svg(const DotSheet& sheet, const std::filesystem::path& path, std::size_t most) {
  const bool whole = sheet.dots.size() <= most;
  const RectangleZone part =
      whole ? sheet.plate : middle(sheet.plate, static_cast<double>(most) / static_cast<double>(sheet.dots.size()));
  const double length = part.x1 - part.x0, width = part.y1 - part.y0;
  StreamedFile file(path);
  fmt::memory_buffer text;
  fmt::format_to(
      fmt::appender(text),
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.6g}mm\" height=\"{1:.6g}mm\" viewBox=\"0 0 {0:.6g} "
      "{1:.6g}\">\n<title>{2}{3}</title>\n<rect width=\"{0:.6g}\" height=\"{1:.6g}\" fill=\"#fff\"/>\n<g "
      "transform=\"translate({4:.6g} {5:.6g}) scale(1 -1)\" fill=\"#123\">\n",
      length, width, escaped(sheet.title), whole ? "" : " (a part in the middle of the plate)", -part.x0, part.y1);
  for (const core::Dot& dot : sheet.dots) {
    const double r = static_cast<double>(dot.radius);
    if (dot.x + r < part.x0 || dot.x - r > part.x1 || dot.y + r < part.y0 || dot.y - r > part.y1) continue;
    add_dot(dot, sheet.footprint, text);
    if (text.size() < kFlush) continue;
    file.write({text.data(), text.size()});
    text.clear();
  }
  fmt::format_to(fmt::appender(text), "</g>\n</svg>\n");
  file.write({text.data(), text.size()});
  file.finish();
}

}  // namespace evenglow::design
