#pragma once

#include <optional>

#include "app/dots_input.h"
#include "app/run_context.h"
#include "core/config/config_node.h"
#include "design/engine/dot_verification.h"
#include "design/report/report.h"

namespace evenglow::app {

/// Notes what stands in the way of `design: {verify: dots}`: shapes that cannot stand as dots, margins that leave no
/// plate, dots too small for the least density, a goal whose levels are not verified.
void check_verify(const core::ConfigNode& root, const Run& run);

/// Lowers the upper limit of the design's density to what the run's dots can hold; the note that tells it, or empty.
std::string keep_to_dots(Run& run);

/// The proof of a design by its dots.
class DotProof {
 public:
  /// What is needed of a run whose backlight goes on to be compiled.
  explicit DotProof(const Run& run);

  /// Fills `report.dots` and `verified`; neither, if the dots cannot be placed. False: interrupted.
  bool add_to(design::Report& report, const design::ForwardModel& model, const design::DesignSpec& spec,
              std::uint64_t photons, const RunContext& context, std::optional<design::VerifiedDots>& verified) const;

  /// Writes the files of the dots into the folder `dots` of the result directory.
  void write(const design::VerifiedDots& verified, const RunContext& context) const;

 private:
  DotsInput input_;
  design::FreeArea free_;
  double fill_;
  std::string label_;  ///< of the variant, with a colon
};

}  // namespace evenglow::app
