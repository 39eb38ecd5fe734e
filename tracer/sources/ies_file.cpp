#include "tracer/sources/ies_file.h"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/config/message_text.h"
#include "tracer/sources/photometric_text.h"

namespace evenglow::tracer {
namespace {

constexpr double kMaxNumber = 1e12;
constexpr std::size_t kMaxAngles = 100000;
constexpr std::size_t kMaxIntensities = 1000000;
constexpr int kMaxLabelLines = 10000;

/// The labels up to the line TILT=. Returns what follows the equals sign.
std::string read_labels(PhotometricText& text, bool& old_format) {
  for (int i = 0; i < kMaxLabelLines; ++i) {
    const std::string_view line = text.next_line("line TILT= of an IES LM-63 file");
    if (i == 0) old_format = !(line.starts_with("IESNA:LM-63-") || line.starts_with("IES:LM-63-"));
    if (line.starts_with("TILT=")) return std::string(line.substr(5));
  }
  text.refuse(fmt::format("must hold a line TILT= within its first {} lines", kMaxLabelLines));
}

/// The factor of the lamp's output at tilt 0.
double read_tilt(PhotometricText& text, const std::string& tilt) {
  if (tilt == "NONE") return 1.0;
  if (tilt != "INCLUDE") {
    text.refuse(
        fmt::format("TILT: must be NONE or INCLUDE (another file is not read), got \"{}\"", core::shown(tilt, 40)));
  }
  text.number("lamp-to-luminaire geometry", 0, 3);
  const std::size_t count = text.count("number of tilt angles", 1, kMaxAngles);
  std::vector<double> angles;
  for (std::size_t i = 0; i < count; ++i) angles.push_back(text.number("tilt angle", -180, 180));
  double factor = 1.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double value = text.number("tilt factor", 0, kMaxNumber);
    if (angles[i] == 0.0) factor = value;
  }
  return factor;
}

std::vector<double> read_angles(PhotometricText& text, const char* what, std::size_t count, double max) {
  std::vector<double> angles;
  for (std::size_t i = 0; i < count; ++i) {
    angles.push_back(text.number(what, 0, max));
    if (i > 0 && angles[i] <= angles[i - 1]) {
      text.refuse(fmt::format("{}s: must rise, got {} after {}", what, angles[i], angles[i - 1]));
    }
  }
  return angles;
}

AzimuthSymmetry symmetry_of(const PhotometricText& text, const std::vector<double>& horizontal) {
  try {
    return symmetry_of_range(horizontal.front(), horizontal.back());
  } catch (const core::Error& error) {
    text.refuse(fmt::format("horizontal angles: {}", error.what()));
  }
}

void to_radians(std::vector<double>& angles) {
  for (double& angle : angles) angle *= core::kRadPerDeg;
}

}  // namespace

IntensityTable read_ies_file(const std::filesystem::path& file) {
  PhotometricText text(file);
  bool old_format = false;
  const std::string tilt = read_labels(text, old_format);
  double factor = read_tilt(text, tilt);
  text.count("number of lamps", 1, 1000000);
  text.number("lumens per lamp", -1, kMaxNumber);
  factor *= text.number("candela multiplier", 1e-9, kMaxNumber);
  const std::size_t vertical_count = text.count("number of vertical angles", 2, kMaxAngles);
  const std::size_t horizontal_count = text.count("number of horizontal angles", 1, kMaxAngles);
  if (vertical_count * horizontal_count > kMaxIntensities) {
    text.refuse(fmt::format("must not hold more than {} intensities, got {} x {}", kMaxIntensities, vertical_count,
                            horizontal_count));
  }
  const std::size_t type = text.count("photometric type", 1, 3);
  if (type != 1) text.refuse(fmt::format("photometric type: must be 1 (type C), got {}", type));
  text.count("units type", 1, 2);
  for (const char* what : {"luminous width", "luminous length", "luminous height"}) text.number(what, -1e6, 1e6);
  factor *= text.number("ballast factor", 1e-9, 1e6);
  const double ballast_lamp_factor = text.number("ballast-lamp photometric factor", 0, 1e6);
  if (old_format) factor *= ballast_lamp_factor;
  text.number("input watts", 0, kMaxNumber);

  std::vector<double> vertical = read_angles(text, "vertical angle", vertical_count, 180);
  if (vertical.front() != 0.0 && vertical.front() != 90.0) {
    text.refuse(fmt::format("vertical angles: must begin with 0 or 90, got {}", vertical.front()));
  }
  std::vector<double> horizontal = read_angles(text, "horizontal angle", horizontal_count, 360);
  const AzimuthSymmetry symmetry = symmetry_of(text, horizontal);
  std::vector<double> values;
  values.reserve(vertical_count * horizontal_count);
  for (std::size_t i = 0; i < vertical_count * horizontal_count; ++i) {
    values.push_back(factor * text.number("intensity", 0, kMaxNumber));
  }
  text.expect_end(fmt::format("{} x {} intensities", horizontal_count, vertical_count));
  to_radians(vertical);
  to_radians(horizontal);
  return whole_circle(std::move(vertical), horizontal, values, symmetry);
}

}  // namespace evenglow::tracer
