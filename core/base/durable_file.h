#pragma once

#include <filesystem>
#include <string_view>

namespace evenglow::core {

/// Opens a new file for writing; the descriptor, below 0 (and `errno`) if that fails. What has the name goes first: a
/// link that someone has put there is removed, not followed, so that no file elsewhere is written to.
int open_anew(const std::filesystem::path& file);

/// Writes a file whole or not at all, so that neither a kill nor a power cut leaves half of it: to FILE.part beside it,
/// flushed to the disk (fsync), renamed, and the folder flushed too, as the new name lives there. An older FILE stays
/// as it was when this fails. Throws `Error`: `cannot write FILE: No space left on device`; FILE.part is removed then.
void write_durably(const std::filesystem::path& file, std::string_view content);

/// The same, and the older FILE is kept as `previous`. At every moment there is a whole file of one of the two names.
void write_durably_keeping(const std::filesystem::path& file, const std::filesystem::path& previous,
                           std::string_view content);

/// Has `bytes` (1 or more) set aside for a file beside others, flushes and removes it: what a full disk, a quota, a
/// read-only folder or a limit of file sizes forbids later, it forbids now. Throws `Error`, `cannot write to FOLDER:
/// reason`.
void prove_writable(const std::filesystem::path& folder, std::size_t bytes);

}  // namespace evenglow::core
