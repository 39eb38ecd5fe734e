#include <cstdio>
#include <exception>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>

#include "bench/verdicts.h"
#include <benchmark/benchmark.h>
#include <fmt/core.h>

namespace evenglow::bench {
namespace {

/// Hands the runs on to the reporter of --benchmark_format and keeps their counters for the table.
class TableReporter final : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& context) override { return display_->ReportContext(context); }

  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
      for (const auto& [name, counter] : run.counters) {
        measurements_[{run.run_name.function_name, name}].push_back(counter.value);
      }
    }
    display_->ReportRuns(runs);
  }

  void Finalize() override { display_->Finalize(); }

  const Measurements& measurements() const { return measurements_; }

 private:
  std::unique_ptr<benchmark::BenchmarkReporter> display_{benchmark::CreateDefaultDisplayReporter()};
  Measurements measurements_;
};

constexpr std::string_view kTableOption = "--table_json=";

/// Takes `--table_json=FILE` out of the arguments; empty if it is not there.
std::string take_table_file(int& argc, char** argv) {
  std::string file;
  int kept = 1;
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument.substr(0, kTableOption.size()) == kTableOption) {
      file = argument.substr(kTableOption.size());
    } else {
      argv[kept++] = argv[i];
    }
  }
  argc = kept;
  return file;
}

/// Standard output may be the JSON of --benchmark_format, so the table goes to standard error.
int run(int argc, char** argv) {
  const std::string file = take_table_file(argc, argv);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  TableReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  fmt::print(stderr, "\n{}", table_text(reporter.measurements()));
  if (file.empty()) return 0;
  std::ofstream out(file);
  out << table_json(reporter.measurements());
  if (out.flush()) return 0;
  fmt::print(stderr, "cannot write {}\n", file);
  return 1;
}

}  // namespace
}  // namespace evenglow::bench

int main(int argc, char** argv) {
  try {
    return evenglow::bench::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "evenglow_bench: {}\n", error.what());
    return 1;
  }
}
