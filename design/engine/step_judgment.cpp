#include "design/engine/step_judgment.h"

#include <algorithm>
#include <cmath>

#include "design/problem/merit.h"
#include "design/problem/target.h"

namespace evenglow::design {

StepRecord make_step_record(int step, const tracer::DensityField& density, const Observation& observation,
                            const DesignSpec& spec) {
  const Evenness even = evenness(Target(spec, observation.map.luminance.grid).judged(observation.luminance));
  const core::Estimate mean = mean_of_cells(observation.luminance);
  StepRecord record;
  record.step = step;
  record.photons = observation.photons;
  record.rms = even.rms;
  record.rms_corrected = even.rms_corrected;
  record.noise =
      std::sqrt(std::max(0.0, even.rms * even.rms - even.rms_corrected.value * std::abs(even.rms_corrected.value)));
  record.efficiency = observation.efficiency;
  record.mean_density = density.cells.mean();
  record.luminance_mean = mean.value * observation.luminance_unit;
  record.cpu_s = observation.cpu_s;
  record.wall_s = observation.wall_s;
  return record;
}

FinalJudgment make_judgment(const Observation& observation, const DesignSpec& spec) {
  const Target target(spec, observation.map.luminance.grid);
  const Evenness even = evenness(target.judged(observation.luminance));
  const core::Estimate mean = mean_of_cells(observation.luminance);
  const core::CellField counted = counted_only(observation.map.luminance, target.relative());
  FinalJudgment judgment;
  judgment.photons = observation.photons;
  judgment.rms = even.rms;
  judgment.rms_corrected = even.rms_corrected;
  judgment.rms_low = even.low;
  judgment.rms_high = even.high;
  judgment.uniformity_9 = uniformity_9(counted);
  judgment.uniformity_13 = uniformity_13(counted);
  judgment.luminance_mean = {mean.value * observation.luminance_unit, mean.se * observation.luminance_unit};
  judgment.luminance_center = center_luminance(counted);
  if (mean.value > 0.0) {
    const SpotErrors errors = spot_errors(observation.luminance, target.relative());
    judgment.uniformity_9_se = errors.uniformity_9;
    judgment.uniformity_13_se = errors.uniformity_13;
    judgment.luminance_center_se = errors.center * observation.luminance_unit;
  }
  judgment.efficiency = observation.efficiency;
  for (const ViewedLuminance& view : observation.views) {
    const core::Estimate seen = mean_of_cells(view.luminance);
    judgment.views.push_back(
        {view.polar_deg,
         view.azimuth_deg,
         view.share,
         evenness(Target(spec, observation.map.luminance.grid).judged(view.luminance)).rms_corrected,
         {seen.value * observation.luminance_unit, seen.se * observation.luminance_unit}});
  }
  return judgment;
}

}  // namespace evenglow::design
