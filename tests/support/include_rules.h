#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

/// Who may include whom: the rules of the house as data, and what a tree of sources does against them.
namespace evenglow::tests {

/// Text of each source by its path from the root (`core/light/stokes.h`).
using SourceTree = std::map<std::string, std::string>;

/// The .h and .cpp files below `root`/`folder` for each of the folders.
SourceTree read_sources(const std::filesystem::path& root, const std::vector<std::string>& folders);

/// A folder and all that its files may include besides their own folder. An entry is a folder (`core/light`) or, with
/// its ending, one header (`core/montecarlo/estimate.h`).
struct FolderRule {
  std::string folder;
  std::vector<std::string> may_use;
};

/// A library and the only places that may include it.
struct LibraryDoor {
  std::string library;
  std::vector<std::string> headers;  ///< how the names of its headers begin (`yaml-cpp/`)
  std::vector<std::string> doors;    ///< how the paths of the files that may include it begin; empty: all
};

struct HouseRules {
  std::vector<std::string> floors;        ///< from the lowest; the first part of every path
  std::vector<std::string> for_everyone;  ///< as `FolderRule::may_use`, for all folders
  std::vector<FolderRule> folders;
  std::vector<LibraryDoor> libraries;
};

/// One line for each fault, `path:line: what`: an include that runs up, a folder the table does not allow, a library
/// outside its door or unknown, a header (but for `-inl.h`) without `#pragma once` at its head, a .cpp whose own header
/// is not its first include.
std::vector<std::string> include_faults(const SourceTree& sources, const HouseRules& rules);

/// Faults of the table itself: an entry that points up, or two folders that may use each other (a circle).
std::vector<std::string> table_faults(const HouseRules& rules);

}  // namespace evenglow::tests
