#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "core/config/key_declarations.h"

namespace evenglow::tests {

/// Random run files from the declarations of their keys (what `evenglow schema` is made of): each key that is not
/// required stands in a file now and then, with a number of its range, mostly near its default, a word of its choices
/// or a map of the same making. What no declaration tells (keys that exclude each other) may make a file that is
/// refused. The same seed gives the same files.
class RunGenerator {
 public:
  RunGenerator(std::vector<core::DeclaredKey> keys, std::uint64_t seed);

  /// One run file: a small backlight, its cells and counts few, so that it is traced quickly.
  std::string next();

 private:
  using Keys = std::vector<const core::DeclaredKey*>;
  bool chance(double share) { return uniform() < share; }
  double uniform() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }
  std::size_t below(std::size_t count) { return count == 0 ? 0 : random_() % count; }

  Keys keys_of(const std::string& node, const std::string& kind) const;
  std::string kind_of(const std::string& node);
  std::string map_of(const std::string& node, int depth);
  std::string value_of(const core::DeclaredKey& key, int depth);
  std::string number_of(const core::DeclaredKey& key, const std::string& fallback);
  std::string numbers_of(const core::DeclaredKey& key);

  std::vector<core::DeclaredKey> keys_;
  std::mt19937_64 random_;
};

}  // namespace evenglow::tests
