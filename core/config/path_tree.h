#pragma once

#include <filesystem>
#include <string>

/// What a path in a run file may name. A file that comes from a stranger must not reach for what it has no business
/// with: relative paths stay in the tree of the run, which is the folder above that of the run file, so that
/// `../data/film.csv` beside `studies/` is in it and `../../../etc/passwd` is not. An absolute path is allowed, as it
/// shows what it is.
namespace evenglow::core {

/// The tree of a run file in `folder`.
std::filesystem::path tree_of(const std::filesystem::path& folder);

/// Why the path `name`, which leads to `file`, may not be used by a run file of `tree`; empty if it may. Symbolic links
/// are followed.
std::string tree_trouble(const std::filesystem::path& tree, const std::filesystem::path& name,
                         const std::filesystem::path& file);

}  // namespace evenglow::core
