#include "design/report/json_dots.h"

#include "design/report/json_metrology.h"

namespace evenglow::design {
namespace {

using Json = nlohmann::ordered_json;

Json round_json(const DotsRound& round) {
  return {{"round", round.record.step},
          {"dots", round.dots},
          {"area_mm2", round.area},
          {"mean_density", round.record.mean_density},
          {"photons", round.record.photons},
          {"rms", round.record.rms},
          {"rms_corrected", round.record.rms_corrected.value},
          {"rms_corrected_se", round.record.rms_corrected.se},
          {"luminance_mean_cd_m2", round.luminance.value},
          {"luminance_mean_se", round.luminance.se},
          {"luminance_over_density", round.over_density.value},
          {"luminance_over_density_se", round.over_density.se}};
}

}  // namespace

nlohmann::ordered_json dots_json(const Report& report) {
  const DotsJudgment& dots = *report.dots;
  Json rounds = Json::array();
  for (const DotsRound& round : dots.rounds) rounds.push_back(round_json(round));
  return {{"dots", dots.rounds[dots.chosen].dots},
          {"chosen_round", dots.rounds[dots.chosen].record.step},
          {"stop_reason", dots.stop_reason},
          {"final", final_json(dots.final)},
          {"luminance_over_density", dots.over_density.value},
          {"luminance_over_density_se", dots.over_density.se},
          {"density_model", final_json(report.final)},
          {"rounds", std::move(rounds)}};
}

}  // namespace evenglow::design
