#include "design/report/output_file.h"

#include "core/base/durable_file.h"

namespace evenglow::design {

void write_file(const std::filesystem::path& path, std::string_view content) {
  core::write_durably(path, content);
}

}  // namespace evenglow::design
