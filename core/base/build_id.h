#pragma once

#include <string>

namespace evenglow::core {

/// Tells one build of the program from another: the checksum of its code and data that the linker leaves in it
/// (`--build-id=sha1`), as 40 hexadecimal digits. The same sources, compiler and options give the same one. Of a
/// program without the note: the SHA-256 of its file; empty where neither can be read.
std::string build_id();

}  // namespace evenglow::core
