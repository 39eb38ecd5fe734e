#include "core/config/path_tree.h"

#include <algorithm>
#include <system_error>

#include "core/config/message_text.h"

namespace evenglow::core {
namespace {

namespace fs = std::filesystem;

fs::path real_path(const fs::path& path) {
  std::error_code error;
  const fs::path whole = fs::absolute(path, error);
  const fs::path real = fs::weakly_canonical(whole, error);
  return error ? whole.lexically_normal() : real;
}

}  // namespace

fs::path tree_of(const fs::path& folder) {
  return real_path(folder.empty() ? fs::path(".") : folder / ".").lexically_normal() / "..";
}

std::string tree_trouble(const fs::path& tree, const fs::path& name, const fs::path& file) {
  if (name.is_absolute()) return "";
  const fs::path root = real_path(tree);
  const fs::path real = real_path(file);
  const auto end = std::mismatch(root.begin(), root.end(), real.begin(), real.end()).first;
  const bool inside = std::all_of(end, root.end(), [](const fs::path& part) { return part.empty(); });
  if (inside) return "";
  return "must stay in the folder above that of the run file (../ once, at most) or be an absolute path, got " +
         shown(name.string(), 200);
}

}  // namespace evenglow::core
