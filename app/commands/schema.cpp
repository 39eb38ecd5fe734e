#include <fmt/core.h>

#include "app/commands/commands.h"
#include "app/key_explorer.h"
#include "app/key_schema.h"

namespace evenglow::app {

int schema_command(const Session& session) {
  const auto keys = explore_keys();
  fmt::print("{}", session.options.reference ? key_reference(keys) : key_schema(keys));
  return kDone;
}

}  // namespace evenglow::app
