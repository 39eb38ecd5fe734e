#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace evenglow::tests {

/// Damages files: flips bits, puts in numbers that are hard on readers (as text and as bytes), cuts, doubles, moves
/// and exchanges parts with other files. The same seed gives the same files.
class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  /// One of the seeds after one to eight damages, at most `kMaxBytes` long.
  std::string next(const std::vector<std::string>& seeds);

  static constexpr std::size_t kMaxBytes = std::size_t{1} << 20;

 private:
  std::size_t below(std::size_t count) { return count == 0 ? 0 : random_() % count; }
  void damage(std::string& bytes, const std::vector<std::string>& seeds);
  void replace_number(std::string& bytes);
  void replace_binary(std::string& bytes);
  void insert_token(std::string& bytes);

  std::mt19937_64 random_;
};

}  // namespace evenglow::tests
