#include "tests/support/include_rules.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <optional>
#include <regex>
#include <set>
#include <sstream>

namespace evenglow::tests {
namespace {

struct Include {
  int line = 0;
  std::string name;
  bool quoted = false;
};

/// A source as the checks see it.
struct Source {
  std::string path;
  std::string first_line;  ///< the first that is neither blank nor a `//` comment
  std::vector<Include> includes;
};

bool is_header(const std::string& path) {
  return path.ends_with(".h");
}

/// Is `path` the file or inside the folder `entry`?
bool within(const std::string& path, const std::string& entry) {
  return path == entry || path.starts_with(entry + '/');
}

bool within_any(const std::string& path, const std::vector<std::string>& entries) {
  return std::ranges::any_of(entries, [&](const std::string& entry) { return within(path, entry); });
}

bool starts_with_any(const std::string& text, const std::vector<std::string>& beginnings) {
  return std::ranges::any_of(beginnings, [&](const std::string& beginning) { return text.starts_with(beginning); });
}

Source parse(const std::string& path, const std::string& text) {
  static const std::regex kInclude(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"].*)");
  Source source{path, {}, {}};
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const auto begin = line.find_first_not_of(" \t\r");
    const bool blank = begin == std::string::npos || line.compare(begin, 2, "//") == 0;
    if (source.first_line.empty() && !blank) source.first_line = line.substr(begin);
    std::smatch match;
    if (std::regex_match(line, match, kInclude)) source.includes.push_back({number, match[2], match[1] == "\""});
  }
  return source;
}

/// Place of a path's floor counted from the lowest, if it is on one.
std::optional<std::size_t> floor_of(const std::string& path, const HouseRules& rules) {
  for (std::size_t i = 0; i < rules.floors.size(); ++i) {
    if (within(path, rules.floors[i])) return i;
  }
  return std::nullopt;
}

/// The rule of the innermost folder that holds `path`.
const FolderRule* rule_of(const std::string& path, const HouseRules& rules) {
  const FolderRule* best = nullptr;
  for (const FolderRule& rule : rules.folders) {
    if (within(path, rule.folder) && (best == nullptr || rule.folder.size() > best->folder.size())) best = &rule;
  }
  return best;
}

std::string house_fault(const Source& source, const Include& include, const HouseRules& rules) {
  const auto from = floor_of(source.path, rules);
  const auto to = floor_of(include.name, rules);
  if (!to) return "a quoted include starts at the root, with one of the floors";
  if (!from || *to > *from) return "an arrow that runs up";
  const FolderRule* rule = rule_of(source.path, rules);
  if (rule == nullptr) return "the folder is not in the table";
  if (within(include.name, rule->folder) || within_any(include.name, rules.for_everyone) ||
      within_any(include.name, rule->may_use)) {
    return {};
  }
  return rule->folder + " may not use it";
}

std::string library_fault(const Source& source, const Include& include, const HouseRules& rules) {
  static const std::regex kStandard("[a-z_0-9]+");
  if (std::regex_match(include.name, kStandard)) return {};
  for (const LibraryDoor& library : rules.libraries) {
    if (!starts_with_any(include.name, library.headers)) continue;
    const bool open = library.doors.empty() || starts_with_any(source.path, library.doors);
    return open ? std::string() : library.library + " outside its door";
  }
  return "a library without a door";
}

/// What is wrong with the head of the file, if anything.
std::string head_fault(const Source& source, const SourceTree& sources) {
  // Read more than once by one source, once for each instruction set: guards of another kind.
  if (source.path.ends_with("-inl.h")) return {};
  if (is_header(source.path)) {
    return source.first_line.starts_with("#pragma once") ? std::string() : "a header begins with #pragma once";
  }
  const std::string own = source.path.substr(0, source.path.rfind('.')) + ".h";
  if (!sources.contains(own)) return {};
  const bool first = !source.includes.empty() && source.includes.front().name == own;
  return first ? std::string() : "its own header is the first include";
}

}  // namespace

SourceTree read_sources(const std::filesystem::path& root, const std::vector<std::string>& folders) {
  SourceTree sources;
  for (const std::string& folder : folders) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
      const auto ending = entry.path().extension();
      if (!entry.is_regular_file() || (ending != ".h" && ending != ".cpp")) continue;
      std::ostringstream text;
      text << std::ifstream(entry.path()).rdbuf();
      sources[entry.path().lexically_relative(root).generic_string()] = text.str();
    }
  }
  return sources;
}

std::vector<std::string> include_faults(const SourceTree& sources, const HouseRules& rules) {
  std::vector<std::string> faults;
  for (const auto& [path, text] : sources) {
    const Source source = parse(path, text);
    const auto note = [&](int line, const std::string& subject, const std::string& fault) {
      if (!fault.empty()) faults.push_back(path + ':' + std::to_string(line) + ": " + subject + fault);
    };
    note(1, "", head_fault(source, sources));
    for (const Include& include : source.includes) {
      note(include.line, include.name + ": ",
           include.quoted ? house_fault(source, include, rules) : library_fault(source, include, rules));
    }
  }
  return faults;
}

std::vector<std::string> table_faults(const HouseRules& rules) {
  std::vector<std::string> faults;
  std::map<std::string, std::set<std::string>> uses;  // from folder to folder, single headers left out
  for (const FolderRule& rule : rules.folders) {
    for (const std::string& entry : rule.may_use) {
      const auto from = floor_of(rule.folder, rules);
      const auto to = floor_of(entry, rules);
      if (!from || !to || *to > *from) faults.push_back(rule.folder + " -> " + entry + ": an arrow that runs up");
      if (!is_header(entry)) uses[rule.folder].insert(entry);
    }
  }
  // Depth first; a folder met again while it is still being visited closes a circle.
  std::set<std::string> open;
  std::set<std::string> done;
  const std::function<void(const std::string&)> visit = [&](const std::string& folder) {
    if (open.contains(folder)) faults.push_back(folder + ": the table goes in a circle");
    if (open.contains(folder) || done.contains(folder)) return;
    open.insert(folder);
    for (const std::string& next : uses[folder]) visit(next);
    open.erase(folder);
    done.insert(folder);
  };
  for (const FolderRule& rule : rules.folders) visit(rule.folder);
  return faults;
}

}  // namespace evenglow::tests
