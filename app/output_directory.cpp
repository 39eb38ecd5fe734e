#include "app/output_directory.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <optional>

#include <fcntl.h>
#include <unistd.h>

#include "core/base/error.h"
#include "core/config/message_text.h"

namespace evenglow::app {

namespace fs = std::filesystem;

namespace {

constexpr std::array<const char*, 42> kResultNames = {
    "result.json",     "compare.json",  "report.html",    "convergence.csv",   "luminance.csv",  "luminance_se.csv",
    "density.csv",     "angular.csv",   "compare.csv",    "convergence.png",   "luminance.png",  "density.png",
    "compare.png",     "color_u.csv",   "color_u_se.csv", "color_v.csv",       "color_v_se.csv", "delta_uv.csv",
    "delta_uv_se.csv", "delta_uv.png",  "hot_spots.csv",  "angular_spots.csv", "batch.json",     "batch.csv",
    "batch.html",      "thumbnail.png", "pareto.json",    "pareto.csv",        "pareto.html",    "pareto.png",
    "bench.json",      "bench.csv",     "bench.txt",      "bench.html",        "bench.png",      "optimize.json",
    "optimize.csv",    "optimize.html", "optimize.png",   "maps.vti",          "density.vti",    "maps.h5"};

std::optional<std::string> first_result(const fs::path& directory) {
  std::error_code ignored;
  for (const char* name : kResultNames) {
    if (fs::exists(directory / name, ignored)) return name;
  }
  return std::nullopt;
}

[[noreturn]] void refuse(const fs::path& directory, const std::string& message) {
  throw core::ConfigError(core::Fault{core::one_line(directory.string()), 0, 0, "", message});
}

void check_is_free(const fs::path& directory) {
  std::error_code ignored;
  if (const auto name = first_result(directory)) {
    refuse(directory, "must not hold another result, got " + *name +
                          " in it (--overwrite replaces it, -o chooses another directory)");
  }
  if (fs::exists(directory / kCheckpointName, ignored)) {
    refuse(directory, std::string("must not hold another run, got ") + kCheckpointName +
                          " in it (--resume goes on with it, --overwrite begins anew)");
  }
}

void check_resumable(const std::vector<fs::path>& places) {
  std::error_code ignored;
  const auto has_state = [&](const fs::path& place) { return fs::exists(place / kCheckpointName, ignored); };
  if (std::any_of(places.begin(), places.end(), has_state)) return;
  for (const fs::path& place : places) {
    if (!first_result(place)) continue;
    refuse(
        place,
        "there is nothing to resume, the result is finished (--overwrite replaces it, -o chooses another directory)");
  }
}

}  // namespace

fs::path output_directory(const Options& options, const fs::path& file) {
  return options.out.empty() ? fs::path("out") / file.stem() : options.out;
}

bool is_result_name(std::string_view name) {
  return std::find(kResultNames.begin(), kResultNames.end(), name) != kResultNames.end() || name == kCheckpointName;
}

void check_free(const fs::path& directory, const std::vector<std::string>& variants, const Options& options) {
  std::vector<fs::path> places = {directory};
  for (const std::string& variant : variants) places.push_back(directory / variant);
  std::error_code ignored;
  for (const fs::path& place : places) {
    if (fs::exists(place, ignored) && !fs::is_directory(place, ignored))
      refuse(place, "must be a directory, got a file");
  }
  if (options.resume) return options.overwrite ? void() : check_resumable(places);
  if (options.overwrite) return;
  for (const fs::path& place : places) check_is_free(place);
}

void make_directory(const fs::path& directory) {
  const auto fail = [&](const std::string& reason) {
    throw core::Error("cannot write to " + core::one_line(directory.string()) + ": " + reason);
  };
  std::error_code failure;
  fs::create_directories(directory, failure);
  if (failure) fail(failure.message());
  const fs::path probe = directory / ".evenglow-probe";
  const int descriptor = ::open(probe.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor < 0) fail(std::error_code(errno, std::generic_category()).message());
  ::close(descriptor);
  fs::remove(probe, failure);
}

void clear_results(const fs::path& directory) {
  std::error_code ignored;
  for (const char* name : kResultNames) fs::remove(directory / name, ignored);
}

}  // namespace evenglow::app
