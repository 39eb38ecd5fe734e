#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/config/config_node.h"
#include "core/montecarlo/photon_rng.h"

/// How a quantity of production varies.
namespace evenglow::design {

/// Standard normal number (Box & Muller, Ann. Math. Stat. 29, 1958).
double draw_normal(core::PhotonRng& rng);

/// Normal numbers are drawn anew when beyond this many standard deviations, as parts that far off are sorted out; the
/// standard deviation of what is left is `kCutDeviation` of the one given.
inline constexpr double kDistributionCut = 3.0;
/// sqrt(1 - 2 c phi(c) / (2 Phi(c) - 1)) at c = 3.
inline constexpr double kCutDeviation = 0.98658;

/// Normal or uniform about a mean, or one of a few values.
struct Distribution {
  enum class Kind { normal, uniform, choices };
  Kind kind = Kind::normal;
  double spread = 0.0;           ///< standard deviation, or half the width
  std::optional<double> mean;    ///< none: the nominal value
  std::vector<double> choices;   ///< values
  std::vector<double> shares{};  ///< of each choice, up to and with it, the last one 1

  double draw(core::PhotonRng& rng, double nominal) const;
  /// The ends of what is drawn.
  double least(double nominal) const;
  double greatest(double nominal) const;
  bool operator==(const Distribution&) const = default;
};

/// Reads one of the keys `normal`, `uniform` and `choices` (with `weights`), and `mean`, from the node of a variation;
/// `quantity` names it and its unit for the reference. A spread of at most `most`.
Distribution read_distribution(const core::ConfigNode& node, double most);

/// The key `normal` alone, for what is drawn for each dot or place: its standard deviation.
double read_deviation(const core::ConfigNode& node, double most);

}  // namespace evenglow::design
