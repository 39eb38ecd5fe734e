#include "app/output_directory.h"

#include <algorithm>
#include <array>
#include <optional>

#include "app/dots_output.h"
#include "core/base/durable_file.h"
#include "core/base/error.h"
#include "core/config/message_text.h"

namespace evenglow::app {

namespace fs = std::filesystem;

namespace {

constexpr std::array<const char*, 51> kResultNames = {"result.json",         "compare.json",
                                                      "report.html",         "convergence.csv",
                                                      "luminance.csv",       "luminance_se.csv",
                                                      "density.csv",         "angular.csv",
                                                      "compare.csv",         "convergence.png",
                                                      "luminance.png",       "density.png",
                                                      "compare.png",         "color_u.csv",
                                                      "color_u_se.csv",      "color_v.csv",
                                                      "color_v_se.csv",      "delta_uv.csv",
                                                      "delta_uv_se.csv",     "delta_uv.png",
                                                      "hot_spots.csv",       "angular_spots.csv",
                                                      "batch.json",          "batch.csv",
                                                      "batch.html",          "thumbnail.png",
                                                      "pareto.json",         "pareto.csv",
                                                      "pareto.html",         "pareto.png",
                                                      "bench.json",          "bench.csv",
                                                      "bench.txt",           "bench.html",
                                                      "bench.png",           "optimize.json",
                                                      "optimize.csv",        "optimize.html",
                                                      "optimize.png",        "maps.vti",
                                                      "density.vti",         "maps.h5",
                                                      "dots_luminance.csv",  "dots_luminance_se.csv",
                                                      "dots_density.csv",    "tolerance.json",
                                                      "tolerance.csv",       "tolerance.html",
                                                      "tolerance.png",       "luminance_mean.csv",
                                                      "luminance_spread.csv"};

constexpr std::size_t kProvedBytes = std::size_t{2} << 20;  // of all that does not grow with the cells

std::optional<std::string> first_result(const fs::path& directory) {
  std::error_code ignored;
  for (const char* name : kResultNames) {
    if (fs::exists(directory / name, ignored)) return name;
  }
  for (const char* name : kDotFiles) {
    if (fs::exists(directory / kDotsFolder / name, ignored)) return std::string(kDotsFolder) + '/' + name;
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
  for (const char* name : {kCheckpointName, kPreviousCheckpointName}) {
    if (!fs::exists(directory / name, ignored)) continue;
    refuse(directory, std::string("must not hold another run, got ") + name +
                          " in it (--resume goes on with it, --overwrite begins anew)");
  }
}

void check_resumable(const std::vector<fs::path>& places) {
  std::error_code ignored;
  const auto has_state = [&](const fs::path& place) {
    return fs::exists(place / kCheckpointName, ignored) || fs::exists(place / kPreviousCheckpointName, ignored);
  };
  if (std::any_of(places.begin(), places.end(), has_state)) return;
  for (const fs::path& place : places) {
    if (!first_result(place)) continue;
    refuse(
        place,
        "there is nothing to resume, the result is finished (--overwrite replaces it, -o chooses another directory)");
  }
}

}  // namespace

std::string run_name(const fs::path& file) {
  const std::string stem = file.stem().string();
  return stem.find_first_not_of('.') == std::string::npos ? "run" : stem;
}

fs::path output_directory(const Options& options, const fs::path& file) {
  return options.out.empty() ? fs::path("out") / run_name(file) : options.out;
}

void check_is_no_link(const fs::path& place) {
  std::error_code ignored;
  if (fs::is_symlink(place, ignored)) refuse(place, "must be a directory, got a symbolic link, which leads elsewhere");
}

bool is_result_name(std::string_view name) {
  return std::find(kResultNames.begin(), kResultNames.end(), name) != kResultNames.end() || name == kCheckpointName ||
         name == kPreviousCheckpointName;
}

void check_free(const fs::path& directory, const std::vector<std::string>& variants, const Options& options) {
  std::vector<fs::path> places = {directory};
  for (const std::string& variant : variants) places.push_back(directory / variant);
  std::error_code ignored;
  for (const fs::path& place : places) {
    if (fs::exists(place, ignored) && !fs::is_directory(place, ignored))
      refuse(place, "must be a directory, got a file");
  }
  for (std::size_t i = 1; i < places.size(); ++i) check_is_no_link(places[i]);
  for (const fs::path& place : places) check_is_no_link(place / kDotsFolder);
  if (options.resume) return options.overwrite ? void() : check_resumable(places);
  if (options.overwrite) return;
  for (const fs::path& place : places) check_is_free(place);
}

void make_directory(const fs::path& directory, std::size_t bytes) {
  const auto fail = [&](const std::string& reason) {
    throw core::Error("cannot write to " + core::one_line(directory.string()) + ": " + reason);
  };
  std::error_code failure;
  fs::create_directories(directory, failure);
  if (failure) fail(failure.message());
  core::prove_writable(directory, kProvedBytes + bytes);
}

fs::path make_subdirectory(const fs::path& directory, const std::string& name, std::size_t bytes) {
  fs::path place = directory / name;
  check_is_no_link(place);
  make_directory(place, bytes);
  return place;
}

OutputLock claim_directory(const fs::path& directory, const std::vector<std::string>& variants, const Options& options,
                           std::size_t bytes) {
  check_not_in_use(directory);
  check_free(directory, variants, options);
  make_directory(directory, bytes);
  OutputLock lock(directory);
  check_free(directory, variants, options);  // another run may have ended in between
  return lock;
}

void write_results(const fs::path& directory, const OutputLock& lock, const std::function<void()>& write) {
  lock.check();
  try {
    write();
  } catch (const std::exception& error) {
    std::error_code ignored;
    if (!fs::exists(directory / kCheckpointName, ignored)) throw;
    throw core::Error(std::string(error.what()) + " (the state is kept: --resume makes the results again)");
  }
}

void clear_results(const fs::path& directory) {
  std::error_code ignored;
  for (const char* name : kResultNames) fs::remove(directory / name, ignored);
  const fs::path dots = directory / kDotsFolder;
  if (fs::is_symlink(dots, ignored)) return;  // what lies elsewhere is of others
  for (const char* name : kDotFiles) fs::remove(dots / name, ignored);
  fs::remove(dots, ignored);  // if nothing else is in it
}

}  // namespace evenglow::app
