#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace evenglow::tracer {

/// A transparent material at one wavelength.
struct Material {
  double refractive_index = 1.0;
  double absorption = 0.0;  ///< 1/mm
};

/// Names that `material` takes.
const std::vector<std::string>& material_names();

/// `pmma`: n^2 - 1 = 1.1819 l^2/(l^2 - 0.011313); `polycarbonate`: n^2 - 1 = 1.4182 l^2/(l^2 - 0.021304), l in um,
/// 0.4368 to 1.052 um (Sultanova, Kasarova, Nikolov, Acta Phys. Pol. A 116, 2009). Bulk loss: 0.03 per metre for
/// light-guide PMMA (0.02 to 0.05 are usual; tables of k for PMMA films mean a hundred times more and do not fit a
/// light guide), 0.3 per metre for optical polycarbonate. `wavelength` in nm. Throws Error for an unknown name.
Material material(std::string_view name, double wavelength);

}  // namespace evenglow::tracer
