#include "design/report/output_file.h"

#include <fstream>
#include <system_error>

#include "core/base/error.h"

namespace evenglow::design {

void write_file(const std::filesystem::path& path, std::string_view content) {
  std::filesystem::path draft = path;
  draft += ".part";
  {
    std::ofstream out(draft, std::ios::binary | std::ios::trunc);
    out.write(content.data(), static_cast<std::streamsize>(content.size()));
    out.close();
    if (!out) throw core::Error("cannot write " + draft.string());
  }
  std::error_code failure;
  std::filesystem::rename(draft, path, failure);
  if (failure) throw core::Error("cannot write " + path.string() + ": " + failure.message());
}

}  // namespace evenglow::design
