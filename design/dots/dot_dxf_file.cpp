#include <fmt/format.h>

#include "core/config/message_text.h"
#include "design/dots/dot_files.h"
#include "design/dots/square_corners.h"
#include "design/dots/streamed_file.h"

namespace evenglow::design {
namespace {

constexpr std::size_t kFlush = 1 << 16;

std::string head(const DotSheet& sheet) {
  const RectangleZone& p = sheet.plate;
  return fmt::format(
      "999\n{}; lengths in "
      "mm\n0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n9\n$EXTMIN\n10\n{:.6f}\n20\n{:.6f}\n30\n0.0\n"
      "9\n$EXTMAX\n10\n{:.6f}\n20\n{:.6f}\n30\n0."
      "0\n0\nENDSEC\n0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n70\n1\n0\nLAYER\n"
      "2\nDOTS\n70\n0\n62\n7\n6\nCONTINUOUS\n0\nENDTAB\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n",
      core::one_line(sheet.title).substr(0, 200), p.x0, p.y0, p.x1, p.y1);
}

void add_square(const core::Dot& dot, fmt::memory_buffer& text) {
  fmt::format_to(fmt::appender(text), "0\nPOLYLINE\n8\nDOTS\n66\n1\n70\n1\n10\n0.0\n20\n0.0\n30\n0.0\n");
  for (const auto& [x, y] : square_corners(static_cast<double>(dot.radius), static_cast<double>(dot.angle)))
    fmt::format_to(fmt::appender(text), "0\nVERTEX\n8\nDOTS\n10\n{:.6f}\n20\n{:.6f}\n30\n0.0\n", dot.x + x, dot.y + y);
  fmt::format_to(fmt::appender(text), "0\nSEQEND\n8\nDOTS\n");
}

}  // namespace

void write_dot_dxf(const DotSheet& sheet, const std::filesystem::path& path) {
  StreamedFile file(path);
  file.write(head(sheet));
  fmt::memory_buffer text;
  for (const core::Dot& dot : sheet.dots) {
    if (sheet.footprint == core::Footprint::round) {
      fmt::format_to(fmt::appender(text), "0\nCIRCLE\n8\nDOTS\n10\n{:.6f}\n20\n{:.6f}\n30\n0.0\n40\n{:.7f}\n", dot.x,
                     dot.y, static_cast<double>(dot.radius));
    } else {
      add_square(dot, text);
    }
    if (text.size() < kFlush) continue;
    file.write({text.data(), text.size()});
    text.clear();
  }
  fmt::format_to(fmt::appender(text), "0\nENDSEC\n0\nEOF\n");
  file.write({text.data(), text.size()});
  file.finish();
}

}  // namespace evenglow::design
