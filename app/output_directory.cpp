#include "app/output_directory.h"

#include <fstream>

#include "core/base/error.h"

namespace evenglow::app {

namespace fs = std::filesystem;

fs::path output_directory(const Options& options, const fs::path& file) {
  return options.out.empty() ? fs::path("out") / file.stem() : options.out;
}

void check_free(const fs::path& directory, const Options& options) {
  std::error_code ignored;
  if (fs::exists(directory, ignored) && !fs::is_directory(directory, ignored)) {
    throw core::ConfigError(core::Fault{directory.string(), 0, 0, "", "must be a directory, got a file"});
  }
  if (options.overwrite || options.resume) return;
  for (const char* name : {"result.json", "compare.json"}) {
    if (!fs::exists(directory / name, ignored)) continue;
    throw core::ConfigError(core::Fault{directory.string(), 0, 0, "", std::string("must not hold another result, got ") + name +
                                        " in it (--overwrite replaces it, -o chooses another directory)"});
  }
  if (fs::exists(directory / "checkpoint.json", ignored)) {
    throw core::ConfigError(core::Fault{directory.string(), 0, 0, "", "must not hold another run, got checkpoint.json in it "
                                        "(--resume goes on with it, --overwrite begins anew)"});
  }
}

void make_directory(const fs::path& directory) {
  std::error_code failure;
  fs::create_directories(directory, failure);
  const fs::path probe = directory / ".evenglow-probe";
  std::ofstream out(probe);
  out << "probe\n";
  out.close();
  if (!out) throw core::Error("cannot write to " + directory.string());
  fs::remove(probe, failure);
}

}  // namespace evenglow::app
