#include "tracer/polarized_bsdf/grid_check.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

#include <fmt/format.h>

#include "core/config/csv_numbers.h"
#include "tracer/polarized_bsdf/bsdf_grid.h"

namespace evenglow::tracer {
namespace {

constexpr std::size_t kMostTold = 10;
constexpr std::size_t kColumns = kLambda + 1;
using Node = std::array<double, kColumns>;  ///< kind, psi, sigma, phi, theta, lambda

Node node_of(const core::CsvNumbers& rows, std::size_t row) {
  Node node;
  for (std::size_t c = 0; c < kColumns; ++c) node[c] = rows.value(row, c);
  return node;
}

std::string described(const Node& n) {
  return fmt::format("{} psi {} sigma {} phi {} theta {} lambda {}", n[0] == 0.0 ? "BRDF" : "BTDF", n[1], n[2], n[3],
                     n[4], n[5]);
}

class GridCheck {
 public:
  explicit GridCheck(const core::CsvNumbers& rows) : rows_(rows) {}

  std::vector<core::Fault> faults() {
    find_repeated();
    const std::size_t in_order = ordered_rows();
    const std::vector<Node> missing = missing_nodes();
    if (!missing.empty() && in_order == rows_.rows() && ends_early(missing)) {
      add(rows_.line(rows_.rows() - 1), fmt::format("must hold every node of its grid, got a file that ends {} nodes "
                                                    "early (truncated?); the first missing is {}",
                                                    missing.size(), described(missing.front())));
      return std::move(faults_);
    }
    for (std::size_t i = 0; i < std::min(missing.size(), kMostTold); ++i) {
      add(line_before(missing[i]),
          fmt::format("must hold every node of its grid, got none for {}", described(missing[i])));
    }
    if (missing.size() > kMostTold) {
      add(0, fmt::format("must hold every node of its grid, got none for {} more", missing.size() - kMostTold));
    }
    if (in_order < rows_.rows() && repeated_ == 0) {
      add(rows_.line(in_order),
          fmt::format("rows must be in the order of the grid, got {} after {}", described(node_of(rows_, in_order)),
                      described(node_of(rows_, in_order - 1))));
    }
    return std::move(faults_);
  }

 private:
  void add(int line, std::string message) {
    faults_.push_back({rows_.name(), line, line > 0 ? 1 : 0, {}, std::move(message)});
  }

  void find_repeated() {
    for (std::size_t r = 0; r < rows_.rows(); ++r) {
      const Node node = node_of(rows_, r);
      const auto [first, is_new] = lines_.emplace(node, rows_.line(r));
      if (is_new) continue;
      if (++repeated_ > kMostTold) continue;
      add(rows_.line(r),
          fmt::format("must hold each node once, got {} again (first on line {})", described(node), first->second));
    }
    if (repeated_ > kMostTold)
      add(0, fmt::format("must hold each node once, got {} more repeated rows", repeated_ - kMostTold));
  }

  std::vector<Node> missing_nodes() const {
    std::array<std::vector<double>, kColumns> axes;
    for (const auto& [node, line] : lines_) {
      for (std::size_t c = 0; c < kColumns; ++c) axes[c].push_back(node[c]);
    }
    for (auto& axis : axes) {
      std::ranges::sort(axis);
      axis.erase(std::unique(axis.begin(), axis.end()), axis.end());
    }
    std::vector<Node> missing;
    std::array<std::size_t, kColumns> digit{};
    constexpr std::size_t kEnough = 1000000;  // a file of scattered points has a huge grid; no one reads all of it
    while (missing.size() < kEnough) {
      Node node;
      for (std::size_t c = 0; c < kColumns; ++c) node[c] = axes[c][digit[c]];
      if (!lines_.contains(node)) missing.push_back(node);
      std::size_t c = kColumns;
      while (c > 0 && ++digit[c - 1] == axes[c - 1].size()) digit[--c] = 0;
      if (c == 0) break;
    }
    return missing;
  }

  /// How many rows from the first on are sorted, by the best order of the columns. Sets `sort_columns_` to it.
  std::size_t ordered_rows() {
    std::array<std::size_t, kColumns> columns;
    std::iota(columns.begin(), columns.end(), std::size_t{0});
    std::size_t best = 0;
    do {
      std::size_t r = 1;
      while (r < rows_.rows() && !before(node_of(rows_, r), node_of(rows_, r - 1), columns)) ++r;
      if (r > best) {
        best = r;
        sort_columns_ = columns;
      }
    } while (best < rows_.rows() && std::next_permutation(columns.begin(), columns.end()));
    return best;
  }

  static bool before(const Node& a, const Node& b, const std::array<std::size_t, kColumns>& columns) {
    for (const std::size_t c : columns) {
      if (a[c] != b[c]) return a[c] < b[c];
    }
    return false;
  }

  bool ends_early(const std::vector<Node>& missing) const {
    const Node last = node_of(rows_, rows_.rows() - 1);
    return std::ranges::all_of(missing, [&](const Node& node) { return before(last, node, sort_columns_); });
  }

  /// Line of the row that stands before the place of a missing node, where rows are in order.
  int line_before(const Node& missing) const {
    int line = rows_.line(0);
    for (std::size_t r = 0; r < rows_.rows() && before(node_of(rows_, r), missing, sort_columns_); ++r)
      line = rows_.line(r);
    return line;
  }

  const core::CsvNumbers& rows_;
  std::map<Node, int> lines_;
  std::size_t repeated_ = 0;
  std::array<std::size_t, kColumns> sort_columns_{};
  std::vector<core::Fault> faults_;
};

}  // namespace

std::vector<core::Fault> grid_faults(const core::CsvNumbers& rows) {
  return GridCheck(rows).faults();
}

}  // namespace evenglow::tracer
