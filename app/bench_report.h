#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "design/engine/method_bench.h"
#include "design/report/study.h"

namespace evenglow::app {

/// The trials of one backlight.
struct BenchCase {
  std::string name;
  std::string title;
  std::size_t cells = 0;
  std::vector<design::MethodTrial> trials;
};

struct BenchFacts {
  std::string command;
  std::vector<double> thresholds;
  std::vector<std::string> updaters;
};

/// Table of medians and spreads; RMS against photons and CPU seconds of the first seed.
design::Study bench_study(const BenchFacts& facts, const std::vector<BenchCase>& cases);

/// bench.csv (a row for each trial and threshold), bench.json, bench.txt, bench.html, bench.png.
void write_bench(const design::Study& study, const BenchFacts& facts, const std::vector<BenchCase>& cases,
                 const std::filesystem::path& directory);

}  // namespace evenglow::app
