#include "design/report/energy_flow.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <regex>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/design/report_samples.h"

namespace evenglow::design {
namespace {

std::string flow_of(const Report& report) {
  return energy_flow(EnergyRows({&report}), 0, report.energy.emitted_lm);
}

struct Node {
  double x, y, height;
};

/// The rectangles of the picture.
std::vector<Node> nodes_of(const std::string& svg) {
  const std::regex rect(
      "<rect class=\"[^\"]*\" x=\"([-0-9.]+)\" y=\"([-0-9.]+)\" width=\"[0-9.]+\" height=\"([-0-9.]+)\"");
  std::vector<Node> nodes;
  for (std::sregex_iterator it(svg.begin(), svg.end(), rect), end; it != end; ++it)
    nodes.push_back({std::stod((*it)[1]), std::stod((*it)[2]), std::stod((*it)[3])});
  return nodes;
}

TEST(EnergyFlow, WidthsAreToScaleAndSumUpInEachColumn) {
  const std::string svg = flow_of(samples::report());
  std::map<double, double> sums;
  for (const Node& node : nodes_of(svg)) sums[node.x] += node.height;
  ASSERT_EQ(sums.size(), 3U);  // emitted, sides and absorbed, destinations
  const double full = sums.begin()->second;
  EXPECT_NEAR(sums.rbegin()->second, full, 0.6);
  EXPECT_NEAR(std::next(sums.begin())->second, 0.45 * full, 0.3);  // 0.1 by the sides, 0.35 absorbed
}

TEST(EnergyFlow, TellsEachShareWithItsError) {
  const std::string svg = flow_of(samples::report());
  for (const char* text : {"50.00 \u00b1 0.10\u00a0%  leaves by the top", "25.000 \u00b1 0.050\u00a0%  white sheet",
                           "absorbed: plate: 10.000 \u00b1 0.050\u00a0%", "absorbed 35.0\u00a0%",
                           "sides 10.0\u00a0%", "emitted 100.0 lm"}) {
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  }
}

TEST(EnergyFlow, LabelsDoNotCollide) {
  Report r = samples::report();
  r.energy.absorbed.clear();
  for (int i = 0; i < 30; ++i) r.energy.absorbed.push_back({fmt::format("part {}", i), {0.35 / 30, 1e-5}});
  std::vector<double> places;
  for (const Node& node : nodes_of(flow_of(r))) {
    if (node.x > 150.0) places.push_back(node.y + 0.5 * node.height);
  }
  ASSERT_EQ(places.size(), 37U);
  std::sort(places.begin(), places.end());
  for (std::size_t i = 1; i < places.size(); ++i) EXPECT_GT(places[i] - places[i - 1], 11.0) << i;
}

TEST(EnergyFlow, LeavesOutWhatHasNoShareAndBearsAnything) {
  Report r = samples::report();
  r.energy.lost = {0.0, 0.0};
  EXPECT_EQ(flow_of(r).find("lost"), std::string::npos);
  r.energy.lost = {std::numeric_limits<double>::quiet_NaN(), 0.0};
  r.energy.absorbed[0].name = "<b>&\"" + std::string(200, 'x') + "\xff";
  const std::string svg = flow_of(r);
  EXPECT_EQ(svg.find("<b>"), std::string::npos);
  EXPECT_EQ(svg.find('\xff'), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_NO_THROW(flow_of(Report{}));
}

}  // namespace
}  // namespace evenglow::design
