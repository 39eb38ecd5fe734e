#include "design/problem/half_angles.h"

#include <cmath>
#include <limits>

namespace evenglow::design {
namespace {

constexpr double kMainLobe = 45.0;  // degrees

/// Luminance against signed angle: its bins in the tally and the weight that makes a mean luminance of their sum.
struct ProfilePoint {
  double angle_deg = 0.0;
  std::vector<std::size_t> bins;
  double weight = 1.0;
};
using Profile = std::vector<ProfilePoint>;

std::vector<std::size_t> azimuths_towards(double azimuth_deg, int count) {
  const double place = azimuth_deg / 360.0 * count;
  const int bin = static_cast<int>(std::floor(place)) % count;
  if (place != std::floor(place) || count == 1) return {static_cast<std::size_t>(bin)};
  return {static_cast<std::size_t>(bin), static_cast<std::size_t>((bin + count - 1) % count)};
}

ProfilePoint point_of(const DirectionBins& bins, std::size_t ring, const std::vector<std::size_t>& azimuths) {
  ProfilePoint point;
  for (const std::size_t azimuth : azimuths) {
    point.bins.push_back(bins.first_bin + ring * static_cast<std::size_t>(bins.azimuth_count) + azimuth);
  }
  point.weight = bins.ring_unit[ring] / static_cast<double>(azimuths.size());
  return point;
}

Profile profile_of(const DirectionBins& bins, double azimuth_deg) {
  const std::size_t rings = bins.ring_unit.size();
  const auto add_side = [&](Profile& profile, std::size_t ring, double side) {
    const double azimuth = std::fmod(azimuth_deg + (side > 0.0 ? 0.0 : 180.0), 360.0);
    profile.push_back(point_of(bins, ring, azimuths_towards(azimuth, bins.azimuth_count)));
    profile.back().angle_deg = side * 90.0 * (static_cast<double>(ring) + 0.5) / static_cast<double>(rings);
  };
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < static_cast<std::size_t>(bins.azimuth_count); ++i) all.push_back(i);
  Profile profile;
  for (std::size_t ring = rings; ring-- > 1;) add_side(profile, ring, -1.0);
  profile.push_back(point_of(bins, 0, all));
  for (std::size_t ring = 1; ring < rings; ++ring) add_side(profile, ring, 1.0);
  return profile;
}

std::vector<double> values_of(const Profile& profile, const std::vector<double>& sums) {
  std::vector<double> values;
  for (const ProfilePoint& point : profile) {
    double sum = 0.0;
    for (const std::size_t bin : point.bins) sum += sums[bin];
    values.push_back(point.weight * sum);
  }
  return values;
}

/// Where the luminance falls below `half` on the way from the point `start` outwards.
std::optional<double> fall(const Profile& profile, const std::vector<double>& values, std::size_t start, double half,
                           bool upwards) {
  const std::size_t end = upwards ? values.size() - 1 : 0;
  for (std::size_t i = start; i != end;) {
    const std::size_t next = upwards ? i + 1 : i - 1;
    if (values[next] < half) {
      const double share = (values[i] - half) / (values[i] - values[next]);
      return std::lerp(profile[i].angle_deg, profile[next].angle_deg, share);
    }
    i = next;
  }
  return std::nullopt;
}

struct Angles {
  double from = 0.0, to = 0.0;
};

std::optional<Angles> angles_of(const Profile& profile, const std::vector<double>& values) {
  std::size_t start = values.size() / 2;  // the normal
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::abs(profile[i].angle_deg) <= kMainLobe && values[i] > values[start]) start = i;
  }
  const double half = 0.5 * values[start];
  if (!(half > 0.0)) return std::nullopt;
  const auto from = fall(profile, values, start, half, false);
  const auto to = fall(profile, values, start, half, true);
  if (!from || !to) return std::nullopt;
  return Angles{*from, *to};
}

double jackknife_se(const std::vector<double>& left_out) {
  const double count = static_cast<double>(left_out.size());
  double mean = 0.0, squares = 0.0;
  for (const double value : left_out) mean += value / count;
  for (const double value : left_out) squares += (value - mean) * (value - mean);
  return std::sqrt(squares * (count - 1.0) / count);
}

}  // namespace

std::optional<HalfAngles> half_angles(const core::Tally& tally, const DirectionBins& bins, double azimuth_deg) {
  const Profile profile = profile_of(bins, azimuth_deg);
  std::vector<std::vector<double>> batches;
  std::vector<double> total(profile.size(), 0.0);
  for (std::size_t b = 0; b < tally.batches(); ++b) {
    batches.push_back(values_of(profile, tally.batch(b)));
    for (std::size_t i = 0; i < total.size(); ++i) total[i] += batches.back()[i];
  }
  const auto found = angles_of(profile, total);
  if (!found) return std::nullopt;
  std::vector<double> from, to, width;
  for (const std::vector<double>& batch : batches) {
    std::vector<double> others = total;
    for (std::size_t i = 0; i < others.size(); ++i) others[i] -= batch[i];
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    const Angles angles = angles_of(profile, others).value_or(Angles{kNone, kNone});
    from.push_back(angles.from);
    to.push_back(angles.to);
    width.push_back(angles.to - angles.from);
  }
  return HalfAngles{
      {found->from, jackknife_se(from)}, {found->to, jackknife_se(to)}, {found->to - found->from, jackknife_se(width)}};
}

}  // namespace evenglow::design
