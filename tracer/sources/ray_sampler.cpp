#include "tracer/sources/ray_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "core/base/error.h"

namespace evenglow::tracer {
namespace {

using core::Vec3;

constexpr std::uint64_t kLeastBlock = 1024;
constexpr std::uint64_t kMaxBlocks = std::uint64_t{1} << 20;
constexpr double kMaxPosition = 1e6;  // mm
constexpr double kUnitSlack = 0.01;
constexpr double kPolarizationSlack = 1e-3;
constexpr double kLeastForward = 1e-6;
constexpr int kRejections = 8;
constexpr std::size_t kChunkBytes = std::size_t{1} << 20;

Vec3 vector_at(const std::byte* record, int column) {
  const std::byte* at = record + static_cast<std::ptrdiff_t>(column) * 4;
  return {little_endian<float>(at), little_endian<float>(at + 4), little_endian<float>(at + 8)};
}

FileRay read_ray(const std::byte* record, const RayFileLayout& layout, RayFileAxis axis) {
  FileRay ray;
  ray.position = layout.mm_per_unit * into_frame(axis, vector_at(record, 0));
  ray.direction = into_frame(axis, vector_at(record, 3));
  ray.flux = little_endian<float>(record + static_cast<std::ptrdiff_t>(layout.flux) * 4);
  if (layout.stokes) {
    ray.stokes = vector_at(record, *layout.stokes);
    ray.axis = into_frame(axis, vector_at(record, *layout.stokes + 3));
  }
  return ray;
}

/// What is wrong with a ray; none if nothing is.
std::optional<std::string> trouble(const FileRay& ray) {
  if (!ray.position.allFinite() || ray.position.cwiseAbs().maxCoeff() > kMaxPosition) {
    return fmt::format("position: must be three numbers within {} mm, got ({}, {}, {})", kMaxPosition, ray.position.x(),
                       ray.position.y(), ray.position.z());
  }
  const double length = ray.direction.norm();
  if (!(std::abs(length - 1.0) <= kUnitSlack)) {
    return fmt::format("direction: must be a unit vector, got the length {}", length);
  }
  if (!(ray.flux >= 0.0) || std::isinf(ray.flux)) return fmt::format("flux: must not be negative, got {}", ray.flux);
  const double degree = ray.stokes.norm();
  if (!(degree <= 1.0 + kPolarizationSlack)) {
    return fmt::format("Stokes parameters: must not have a degree of polarization above 1, got {}", degree);
  }
  if (degree > 0.0 && !(ray.direction.cross(ray.axis).norm() > 1e-3 * ray.axis.norm() && ray.axis.allFinite())) {
    return std::string("polarization axis: must be across the direction, got none");
  }
  return std::nullopt;
}

double forward_flux(const FileRay& ray) {
  return ray.direction.z() > kLeastForward ? ray.flux : 0.0;
}

std::uint64_t block_size(std::uint64_t rays) {
  return std::max(kLeastBlock, (rays + kMaxBlocks - 1) / kMaxBlocks);
}

}  // namespace

Vec3 into_frame(RayFileAxis axis, const Vec3& v) {
  switch (axis) {
    case RayFileAxis::kPlusX:
      return {v.y(), v.z(), v.x()};
    case RayFileAxis::kMinusX:
      return {v.y(), -v.z(), -v.x()};
    case RayFileAxis::kPlusY:
      return {v.z(), v.x(), v.y()};
    case RayFileAxis::kMinusY:
      return {v.z(), -v.x(), -v.y()};
    case RayFileAxis::kMinusZ:
      return {v.x(), -v.y(), -v.z()};
    default:
      return v;
  }
}

RayFlux scan_rays(const std::filesystem::path& path, const RayFileLayout& layout, RayFileAxis axis) {
  const BinaryFile file(path);
  const std::uint64_t record = layout.record_bytes();
  const std::uint64_t per_chunk = std::max<std::uint64_t>(1, kChunkBytes / record);
  std::vector<std::byte> bytes(per_chunk * record);
  RayFlux flux;
  flux.rays_per_block = block_size(layout.rays);
  for (std::uint64_t first = 0; first < layout.rays; first += per_chunk) {
    const std::uint64_t count = std::min(per_chunk, layout.rays - first);
    file.read(layout.first_byte + first * record, std::span(bytes).first(count * record));
    for (std::uint64_t i = 0; i < count; ++i) {
      const FileRay ray = read_ray(bytes.data() + i * record, layout, axis);
      if (const auto fault = trouble(ray)) file.refuse(fmt::format("ray {}: {}", first + i + 1, *fault));
      if ((first + i) % flux.rays_per_block == 0) {
        flux.cumulative.push_back(flux.forward);
        flux.largest.push_back(0.0F);
      }
      const double forward = forward_flux(ray);
      flux.cumulative.back() = flux.forward += forward;
      flux.largest.back() = std::max(flux.largest.back(), static_cast<float>(forward));
      flux.backward += ray.flux - forward;
    }
  }
  if (!(flux.forward > 0.0)) {
    file.refuse(flux.backward > 0.0 ? "must hold light that goes along the axis into the backlight, got all against it"
                                    : "must hold rays with a flux above 0, got none");
  }
  return flux;
}

RaySampler::RaySampler(const std::filesystem::path& file, const RayFileLayout& layout, RayFileAxis axis, RayFlux flux)
    : file_(file), layout_(layout), axis_(axis), flux_(std::move(flux)) {
  if (file_.size() != layout.first_byte + layout.rays * layout.record_bytes()) {
    file_.refuse("has changed since its head was read");
  }
}

FileRay RaySampler::sample(core::PhotonRng& rng) const {
  const double at = rng.uniform() * flux_.forward;
  const auto end = std::lower_bound(flux_.cumulative.begin(), flux_.cumulative.end(), flux_.forward);
  const auto found = std::min(std::upper_bound(flux_.cumulative.begin(), flux_.cumulative.end(), at), end);
  const auto block = static_cast<std::uint64_t>(found - flux_.cumulative.begin());
  const std::uint64_t first = block * flux_.rays_per_block;
  const std::uint64_t count = std::min(flux_.rays_per_block, layout_.rays - first);
  FileRay ray = sample_in_block(rng, first, count, flux_.largest[block]);
  ray.direction.normalize();
  return ray;
}

FileRay RaySampler::sample_in_block(core::PhotonRng& rng, std::uint64_t first, std::uint64_t count,
                                    double largest) const {
  // Rejection reads one ray a try. Each try that fails leaves the odds as they were, so going over to the whole block
  // after some of them is exact too.
  for (int i = 0; i < kRejections; ++i) {
    const auto index = std::min(static_cast<std::uint64_t>(rng.uniform() * static_cast<double>(count)), count - 1);
    FileRay ray = ray_at(first + index);
    if (rng.uniform() * largest < forward_flux(ray)) return ray;
  }
  return search_block(rng.uniform(), first, count);
}

FileRay RaySampler::ray_at(std::uint64_t index) const {
  constexpr std::size_t kUsual = 64;
  const std::uint64_t record = layout_.record_bytes();
  std::array<std::byte, kUsual> small{};
  std::vector<std::byte> large;
  if (record > kUsual) large.resize(record);
  const std::span<std::byte> bytes = record > kUsual ? std::span(large) : std::span(small).first(record);
  file_.read(layout_.first_byte + index * record, bytes);
  return read_ray(bytes.data(), layout_, axis_);
}

FileRay RaySampler::search_block(double share, std::uint64_t first, std::uint64_t count) const {
  const std::uint64_t record = layout_.record_bytes();
  std::vector<std::byte> bytes(count * record);
  file_.read(layout_.first_byte + first * record, bytes);
  const auto ray = [&](std::uint64_t i) { return read_ray(bytes.data() + i * record, layout_, axis_); };
  double sum = 0.0;
  for (std::uint64_t i = 0; i < count; ++i) sum += forward_flux(ray(i));
  double at = share * sum;
  FileRay last;
  for (std::uint64_t i = 0; i < count; ++i) {
    const FileRay candidate = ray(i);
    const double flux = forward_flux(candidate);
    if (flux <= 0.0) continue;
    last = candidate;
    if (at < flux) break;
    at -= flux;
  }
  core::expects(last.flux > 0.0, "a block that was chosen by its flux holds light");
  return last;
}

}  // namespace evenglow::tracer
