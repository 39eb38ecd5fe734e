#pragma once

#include <vector>

#include "core/config/key_declarations.h"

namespace evenglow::app {

/// Every key that any run file may hold, as its readers declare it.
///
/// The readers are run on small made run files: a map is entered, each word of a choice and each kind of a part is
/// tried, each key is given once, until nothing new is declared. So the list cannot differ from what is read. A key
/// that is declared as of several types (a word or a map) stands in the list once for each.
std::vector<core::DeclaredKey> explore_keys();

}  // namespace evenglow::app
