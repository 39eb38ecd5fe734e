#include "tracer/sources/eulumdat_file.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "core/base/units.h"
#include "tracer/sources/photometric_text.h"

namespace evenglow::tracer {
namespace {

constexpr double kMaxNumber = 1e12;
constexpr std::size_t kMaxIntensities = 1000000;

struct Grid {
  std::size_t symmetry = 0;   // Isym
  std::size_t planes = 0;     // Mc
  std::size_t gammas = 0;     // Ng
  double cd_per_value = 0.0;  // that turns cd / 1000 lm into cd
};

void skip_lines(PhotometricText& text, const char* what, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) text.next_line(what);
}

/// Flux (lm) of the first set of lamps; of all lamps of the set together.
double read_lamps(PhotometricText& text) {
  const std::size_t sets = text.count_line("number of sets of lamps (line 26)", 1, 20);
  double flux = 0.0;
  for (std::size_t i = 0; i < sets; ++i) {
    text.number_line("number of lamps (line 26a)", -1e6, 1e6);
    text.next_line("type of lamps (line 26b)");
    const double set = text.number_line("flux of the lamps (line 26c)", 1e-9, kMaxNumber);
    if (i == 0) flux = set;
    skip_lines(text, "color and power of the lamps (lines 26d to 26f)", 3);
  }
  return flux;
}

Grid read_head(PhotometricText& text) {
  Grid grid;
  text.next_line("company (line 1)");
  text.count_line("type indicator Ityp (line 2)", 0, 3);
  grid.symmetry = text.count_line("symmetry indicator Isym (line 3)", 0, 4);
  grid.planes = text.count_line("number of C planes Mc (line 4)", 1, 100000);
  text.number_line("distance between C planes Dc (line 5)", 0, 360);
  grid.gammas = text.count_line("number of gamma angles Ng (line 6)", 2, 100000);
  text.number_line("distance between gamma angles Dg (line 7)", 0, 180);
  const std::size_t divisor = grid.symmetry >= 3 ? 4 : grid.symmetry == 2 ? 2 : 1;
  if (grid.planes % divisor != 0) {
    text.refuse(fmt::format("number of C planes Mc: must be a multiple of {} with Isym {}, got {}", divisor,
                            grid.symmetry, grid.planes));
  }
  if (grid.planes * grid.gammas > kMaxIntensities) {
    text.refuse(
        fmt::format("must not hold more than {} intensities, got {} x {}", kMaxIntensities, grid.planes, grid.gammas));
  }
  skip_lines(text, "names and dimensions (lines 8 to 21)", 14);
  text.next_line("downward flux fraction (line 22)");
  text.next_line("light output ratio (line 23)");
  grid.cd_per_value = text.number_line("conversion factor for intensities (line 24)", 1e-9, 1e9);
  text.next_line("tilt during measurement (line 25)");
  grid.cd_per_value *= read_lamps(text) / 1000.0;
  skip_lines(text, "direct ratios (line 27)", 10);
  return grid;
}

std::vector<double> read_angles(PhotometricText& text, const char* what, std::size_t count, double max) {
  std::vector<double> angles;
  for (std::size_t i = 0; i < count; ++i) {
    angles.push_back(text.number_line(what, 0, max));
    if (i > 0 && angles[i] <= angles[i - 1]) {
      text.refuse(fmt::format("{}s: must rise, got {} after {}", what, angles[i], angles[i - 1]));
    }
  }
  if (angles.front() != 0.0) text.refuse(fmt::format("{}s: must begin with 0, got {}", what, angles.front()));
  for (double& angle : angles) angle *= core::kRadPerDeg;
  return angles;
}

/// The planes that the file holds intensities of, in its order: Mc1 to Mc2 of the format's definition.
std::vector<std::size_t> planes_given(const Grid& grid) {
  const std::size_t first = grid.symmetry == 3 ? 3 * grid.planes / 4 : 0;
  std::size_t count = grid.planes;
  if (grid.symmetry == 1) count = 1;
  if (grid.symmetry == 2 || grid.symmetry == 3) count = grid.planes / 2 + 1;
  if (grid.symmetry == 4) count = grid.planes / 4 + 1;
  std::vector<std::size_t> planes;
  for (std::size_t i = 0; i < count; ++i) planes.push_back(first + i);
  return planes;
}

/// Azimuth of plane `index`; those from Mc on have gone around, the range of Isym 3 runs from -90 to 90 degrees.
double azimuth(const Grid& grid, const std::vector<double>& angles, std::size_t index) {
  const double whole = 2.0 * core::kPi;
  if (grid.symmetry == 3) return index < grid.planes ? angles[index] - whole : angles[index - grid.planes];
  return index < grid.planes ? angles[index] : angles[index - grid.planes] + whole;
}

AzimuthSymmetry symmetry_of(const Grid& grid) {
  constexpr AzimuthSymmetry kOfIsym[] = {AzimuthSymmetry::kNone, AzimuthSymmetry::kRotation,
                                         AzimuthSymmetry::kPlane0To180, AzimuthSymmetry::kPlane90To270,
                                         AzimuthSymmetry::kQuadrant0To90};
  return kOfIsym[grid.symmetry];
}

/// The planes of a half or quarter must reach from edge to edge of it.
void check_span(const PhotometricText& text, const Grid& grid, const std::vector<double>& phi) {
  constexpr double kSlack = 1e-6;
  const double right = 0.5 * core::kPi;
  double first = 0.0;
  double last = 0.0;
  if (grid.symmetry == 2) last = 2.0 * right;
  if (grid.symmetry == 3) std::tie(first, last) = std::pair(-right, right);
  if (grid.symmetry == 4) last = right;
  if (grid.symmetry < 2 || (std::abs(phi.front() - first) < kSlack && std::abs(phi.back() - last) < kSlack)) return;
  text.refuse(fmt::format("C angles: must run from {:.0f} to {:.0f} degrees with Isym {}, got {:.6g} to {:.6g}",
                          first / core::kRadPerDeg, last / core::kRadPerDeg, grid.symmetry,
                          phi.front() / core::kRadPerDeg, phi.back() / core::kRadPerDeg));
}

}  // namespace

IntensityTable read_eulumdat_file(const std::filesystem::path& file) {
  PhotometricText text(file);
  const Grid grid = read_head(text);
  const std::vector<double> c_angles = read_angles(text, "C angle", grid.planes, 360);
  std::vector<double> gammas = read_angles(text, "gamma angle", grid.gammas, 180);
  std::vector<double> phi;
  std::vector<double> values;
  for (const std::size_t plane : planes_given(grid)) {
    phi.push_back(azimuth(grid, c_angles, plane));
    for (std::size_t j = 0; j < grid.gammas; ++j) {
      values.push_back(grid.cd_per_value * text.number_line("intensity", 0, kMaxNumber));
    }
  }
  text.expect_end(fmt::format("{} x {} intensities", phi.size(), grid.gammas));
  check_span(text, grid, phi);
  return whole_circle(std::move(gammas), phi, values, symmetry_of(grid));
}

}  // namespace evenglow::tracer
