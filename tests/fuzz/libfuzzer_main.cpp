#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "tests/fuzz/fuzz_run.h"
#include "tests/fuzz/mutator.h"
#include "tests/support/temp_folder.h"

/// The targets for libFuzzer, which keeps damaged files that reach new code and damages them further. The target is
/// named by the variable EVENGLOW_FUZZ_TARGET; with EVENGLOW_FUZZ_SEEDS its seeds are written to that folder first.
namespace {

using namespace evenglow::tests;

const FuzzTarget* chosen_target() {
  const char* name = std::getenv("EVENGLOW_FUZZ_TARGET");
  for (const FuzzTarget& target : fuzz_targets()) {
    if (name && target.name == name) return &target;
  }
  return nullptr;
}

const FuzzTarget& target() {
  static const FuzzTarget* const chosen = chosen_target();
  return *chosen;
}

}  // namespace

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  if (!chosen_target()) {
    std::fprintf(stderr, "EVENGLOW_FUZZ_TARGET must be one of:");
    for (const FuzzTarget& each : fuzz_targets()) std::fprintf(stderr, " %s", each.name.c_str());
    std::fprintf(stderr, "\n");
    std::exit(2);
  }
  if (const char* folder = std::getenv("EVENGLOW_FUZZ_SEEDS")) {
    std::size_t number = 0;
    for (const std::string& seed : target().seeds) {
      write_text(std::string(folder) + "/seed-" + std::to_string(number++), seed);
    }
  }
  return 0;
}

/// Half of the damages are ours, which know what is hard on readers of text and numbers.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  if (seed % 2 == 0) return LLVMFuzzerMutate(data, size, most);
  std::vector<std::string> files = {std::string(reinterpret_cast<const char*>(data), size)};
  Mutator mutator(seed);
  const std::string next = mutator.next(files);
  const std::size_t length = std::min(next.size(), most);
  std::memcpy(data, next.data(), length);
  return length;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  bool accepted = false;
  const std::string finding = read_one(target(), std::string_view(reinterpret_cast<const char*>(data), size), accepted);
  if (!finding.empty()) {
    std::fprintf(stderr, "finding: %s: %s\n", target().name.c_str(), finding.c_str());
    std::abort();
  }
  return 0;
}
