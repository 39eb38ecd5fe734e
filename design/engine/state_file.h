#pragma once

#include <filesystem>
#include <functional>
#include <string>

/// The states of interrupted work on the disk: `checkpoint.json` and, from one step before, `checkpoint.previous.json`.
///
/// A state is one JSON object on one line whose first key, `sha256`, holds the SHA-256 of the file without that key:
/// every other byte counts, so that an altered or cut file is told from a whole one whatever was done to it.
namespace evenglow::design {

/// `out/checkpoint.json` -> `out/checkpoint.previous.json`.
std::filesystem::path previous_state(const std::filesystem::path& file);

/// The state with its checksum, and back. `object`: a JSON object with at least one key, on one line. `unsealed_state`
/// throws core::Error if the checksum is wrong or missing.
std::string sealed_state(const std::string& object);
std::string unsealed_state(const std::string& text);

/// Writes the state durably and keeps the one before. Throws core::Error; the last good state is there then.
void save_state(const std::filesystem::path& file, const std::string& object);

/// Hands the newest good state to `read`, which throws for one that it cannot use. False: there is none. `note`: told
/// in one line if it was that of the step before, as the newest is damaged or gone. Throws core::Error with the reason
/// of the newest if none is good.
bool load_state(const std::filesystem::path& file, const std::function<void(const std::string& object)>& read,
                std::string& note);

/// Removes both.
void remove_state(const std::filesystem::path& file);

}  // namespace evenglow::design
