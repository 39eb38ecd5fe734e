#pragma once

#include <string>
#include <vector>

#include "core/config/key_declarations.h"

namespace evenglow::app {

/// JSON Schema (draft 7) of the run file: what keys there are, of which type, range and choices, with help, unit and
/// default. What no schema can tell (two keys that exclude each other, sums of shares, files that must exist) is left
/// to `evenglow check`.
std::string key_schema(const std::vector<core::DeclaredKey>& keys);

/// The same as tables in Markdown, a part for each map and kind: docs/keys.md.
std::string key_reference(const std::vector<core::DeclaredKey>& keys);

}  // namespace evenglow::app
