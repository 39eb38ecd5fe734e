#include "core/base/version.h"

namespace evenglow::core {

std::string_view version() {
  return EVENGLOW_VERSION;
}

}  // namespace evenglow::core
