#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// How a reader declares the keys that it takes: name, help, what is allowed, fallback.
namespace evenglow::core {

/// Allowed numbers, in the unit of the file.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool min_open = false;  ///< min itself is not allowed
  bool max_open = false;  ///< max itself is not allowed

  static constexpr Range any() { return {}; }
  static constexpr Range positive(double max = std::numeric_limits<double>::infinity()) {
    return {0, max, true, false};
  }
  static constexpr Range closed(double min, double max) { return {min, max, false, false}; }

  bool contains(double value) const;
  std::string to_string() const;  ///< `[0, 180)`; infinite ends as in mathematics
};

/// One key that holds a number. A key that ends in a unit is converted to ours:
/// `_mm` mm, `_um` mm, `_deg` rad, `_lm` lm, `_nm` nm, `_per_m` 1/mm, `_per_mm` 1/mm; no such ending: unchanged.
struct NumberKey {
  std::string_view key;
  std::string_view help;             ///< one sentence for the key reference
  Range range;                       ///< in the unit of the file
  std::optional<double> fallback{};  ///< in the unit of the file; none: the key is required
};

struct IntegerKey {
  std::string_view key;
  std::string_view help;
  long long min = 0;
  long long max = std::numeric_limits<long long>::max();
  std::optional<long long> fallback{};
};

struct TextKey {
  std::string_view key;
  std::string_view help;
  std::optional<std::string> fallback{};
  std::size_t max_length = 1000;  ///< in bytes
};

struct BoolKey {
  std::string_view key;
  std::string_view help;
  std::optional<bool> fallback{};
};

/// One of a few words. For a list of such words (`choices`) the fallback parts its words by commas; an empty one is an
/// empty list.
struct ChoiceKey {
  std::string_view key;
  std::string_view help;
  std::vector<std::string> options;
  std::optional<std::string> fallback{};
};

/// A list of `min_count` to `max_count` numbers (both equal: exactly so many).
struct NumbersKey {
  std::string_view key;
  std::string_view help;
  Range range;
  std::size_t min_count = 0;
  std::size_t max_count = 1000000;
  std::optional<std::vector<double>> fallback{};  ///< in the unit of the file
  bool whole = false;                             ///< only whole numbers (counts of cells)
};

/// A declaration as the document remembers it, for the key reference and the JSON schema.
struct DeclaredKey {
  std::string node;  ///< path of the map that holds the key, indices as `[]`: `backlight.films[]`; empty: the top
  std::string kind;  ///< value of the map's key `kind` when the key was declared; empty: none so far
  std::string key;
  std::string type;  ///< number, integer, count, text, boolean, choice, numbers, choices, file, map, maps
  std::string help;
  std::string unit{};  ///< that the key ends in; empty: none
  bool required = false;
  std::string fallback{};              ///< as YAML text, in the unit of the file; empty: none
  std::optional<Range> range{};        ///< of a number, in the unit of the file; of a text, its length in bytes
  std::vector<std::string> options{};  ///< of a choice
  std::size_t min_count = 0;           ///< of a list
  std::size_t max_count = 0;           ///< of a list; 0: no list
  bool whole = false;                  ///< of numbers: only whole ones
};

/// A key that a reader asked for without a declaration: what it is shows only in a file that holds it.
struct MentionedKey {
  std::string node;  ///< as of `DeclaredKey`
  std::string kind;
  std::string key;

  bool operator==(const MentionedKey&) const = default;
};

}  // namespace evenglow::core
