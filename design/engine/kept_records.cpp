#include "design/engine/kept_records.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "tracer/transport/arrival_records.h"

namespace evenglow::design {
namespace {

constexpr double kMostPhotons = 1e12;                     // as `trace.photons` allows
constexpr const char* kRecordedSteps = "recorded_steps";  // in the memory: step, photons and density of each
constexpr std::size_t kMostBytes = std::size_t{512} << 20;

std::size_t bytes_of(const std::vector<RecordedTrace>& traces) {
  std::size_t sum = 0;
  for (const RecordedTrace& trace : traces) sum += trace.records->bytes();
  return sum;
}

}  // namespace

void KeptRecords::keep(const tracer::DensityField& density, const Observation& observation, std::uint32_t step,
                       UpdaterMemory& memory) {
  if (!observation.records) return;
  traces_.push_back({observation.records, observation.luminance, observation.photons, step, density.cells});
  while (traces_.size() > 1 && bytes_of(traces_) > kMostBytes) traces_.erase(traces_.begin());
  auto& told = memory[kRecordedSteps];
  told.clear();
  for (const RecordedTrace& trace : traces_) {
    told.push_back(trace.step);
    told.push_back(static_cast<double>(trace.photons));
    told.insert(told.end(), trace.density.values.begin(), trace.density.values.end());
  }
}

bool KeptRecords::restore(const ForwardModel& model, tracer::DensityField density, std::uint32_t step,
                          UpdaterMemory& memory) {
  const auto told = memory.find(kRecordedSteps);
  if (!traces_.empty() || told == memory.end()) return true;
  const std::vector<double> list = told->second;
  const std::size_t cells = density.cells.values.size();
  for (std::size_t at = 0; at + 2 + cells <= list.size(); at += 2 + cells) {
    // A state may come from anyone: numbers that are none of a step's end it.
    if (!(list[at] >= 0.0 && list[at] < step && list[at + 1] >= 1.0 && list[at + 1] <= kMostPhotons)) break;
    const auto number = static_cast<std::uint32_t>(list[at]);
    const auto values = list.begin() + static_cast<std::ptrdiff_t>(at) + 2;
    std::copy(values, values + static_cast<std::ptrdiff_t>(cells), density.cells.values.begin());
    auto again = model.recording(density, static_cast<std::uint64_t>(list[at + 1]), number);
    if (!again) return false;
    keep(density, *again, number, memory);
  }
  return true;
}

}  // namespace evenglow::design
