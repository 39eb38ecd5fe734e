#include "tests/support/shipped_backlight.h"

#include "core/base/error.h"
#include "core/config/config_node.h"

namespace evenglow::tests {

tracer::BacklightSpec shipped_backlight(const std::string& file, const std::string& variant) {
  auto document = core::ConfigDocument::load(std::string(EVENGLOW_SOURCE_DIR) + "/configs/" + file);
  bool found = variant.empty();
  const auto variants = document.variants();
  for (const auto& [name, changes] : variants) {
    if (name != variant) continue;
    for (const auto& change : changes) document.apply(change);
    found = true;
  }
  core::expects(found, "a test names a variant that its run file has");
  return tracer::read_backlight(document.root().map("backlight", "the backlight"));
}

}  // namespace evenglow::tests
