#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tracer/polarized_bsdf/diattenuator_fit.h"
#include "tracer/polarized_bsdf/film_readings.h"
#include "tracer/polarized_bsdf/mueller_fit.h"
#include "tracer/polarized_bsdf/polarizer.h"

namespace evenglow::tracer {

/// Where polarizer angles count from: the film's pass axis, or e1 of the ray (then psi is taken off delta).
enum class AngleOrigin { film, laboratory };

struct ReconstructionOptions {
  AngleOrigin angles = AngleOrigin::film;
  DiattenuationBias bias = DiattenuationBias::none;
  PrincipalTransmittances polarizer;  ///< in the illumination channel
  PrincipalTransmittances analyzer;   ///< in the observation channel
};

/// One node of the table. Standard errors are 0 where the readings have none.
struct NodeResult {
  FilmNode node;
  int line = 0;               ///< of its first reading
  DiattenuatorValues values;  ///< delta from the film axis
  double kappa = 1.0;         ///< 1 where only the illumination channel had polarizers: they cannot tell it
  double chi_square = 0.0;
  int degrees_of_freedom = 0;
  std::optional<MuellerFit> mueller;  ///< of general readings; in the frames that the angles were counted in
  double rest = 0.0;                  ///< of general readings: what the table leaves out of M (TableForm)

  /// How much worse than noise the fit is, in standard errors of a normal variable (Wilson & Hilferty 1931; for one
  /// degree of freedom the root of chi-square). 0 without redundant readings.
  double excess() const;
  /// How much more than noise the readings contradict every physical matrix, in standard errors of a normal variable:
  /// the increase of chi-square against a chi-square with 9 degrees of freedom, which bounds it for any film but a
  /// black one (a matrix of rank 1 has 16 - 7 directions that noise can push out of the cone). So it errs towards 0.
  double contradiction() const;
};

struct Reconstruction {
  std::string name;  ///< of the readings
  bool general = false;
  AngleOrigin angles = AngleOrigin::film;
  bool has_errors = false;  ///< false: neither given nor to be had from redundant readings
  /// Standard error over the root mean square reading of a node, where the file gave none: from the redundant readings
  /// of all nodes.
  std::optional<double> estimated_error;
  std::vector<NodeResult> nodes;  ///< ascending by node
};

/// Runs `work(i)` for i = 0 .. count - 1, in any order, on any threads.
using ForEach = std::function<void(std::size_t count, const std::function<void(std::size_t)>& work)>;
void one_after_another(std::size_t count, const std::function<void(std::size_t)>& work);

/// Throws `core::ConfigError`: a node with readings at fewer than three angles; of general readings, a node whose
/// readings do not determine all 16 entries. The first ten are told.
Reconstruction reconstruct(const FilmReadings& readings, const ReconstructionOptions& options,
                           const ForEach& for_each = one_after_another);

/// Readings of a group as the general fit takes them. Right circular light has V = -1 where the ray travels down (the
/// illumination, and transmitted light) and +1 where it travels up, as the tangential count has it.
std::vector<MuellerReading> mueller_readings(const ReadingGroup& group, const ReconstructionOptions& options);

}  // namespace evenglow::tracer
