#include "design/report/energy_flow.h"

#include <algorithm>

#include <fmt/format.h>

#include "design/report/number_format.h"
#include "design/report/text_escape.h"

namespace evenglow::design {
namespace {

constexpr double kWidth = 468.0;  ///< px, as all below
constexpr double kFull = 230.0;   ///< height of a share of 1
constexpr double kNode = 10.0;    ///< width of a node
constexpr double kText = 11.5;
constexpr double kPitch = 15.0;  ///< between labels at least
constexpr double kTop = 22.0;    ///< room for the heading
constexpr double kColumns[] = {0.0, 118.0, 222.0};

struct Leaf {
  std::size_t row = 0;
  double share = 0.0;
  double top = 0.0;  ///< px
};

/// The destinations of one fate.
struct Branch {
  Fate fate = Fate::top;
  std::vector<Leaf> leaves;

  double share() const {
    double sum = 0.0;
    for (const Leaf& leaf : leaves) sum += leaf.share;
    return sum;
  }
  /// One leaf alone needs no node between.
  bool forked() const { return leaves.size() > 1; }
};

double thickness(double share) {
  return std::max(share * kFull, 0.6);
}

std::vector<Branch> branches_of(const EnergyRows& account, std::size_t report) {
  std::vector<Branch> branches;
  double y = kTop;
  for (const Fate fate : {Fate::top, Fate::side, Fate::absorbed, Fate::lost}) {
    Branch branch{fate, {}};
    for (std::size_t i = 0; i < account.rows().size(); ++i) {
      const Destination& row = account.rows()[i];
      if (row.fate != fate || !row.shares[report] || !(row.shares[report]->value > 0.0)) continue;
      // In the middle of a slot as high as its label at least: labels never meet.
      const double height = thickness(row.shares[report]->value);
      const double slot = std::max(height + 3.0, kPitch);
      branch.leaves.push_back({i, row.shares[report]->value, y + 0.5 * (slot - height)});
      y += slot;
    }
    if (!branch.leaves.empty()) branches.push_back(std::move(branch));
  }
  return branches;
}

/// A band from one node's right side to another's left side, both of the same thickness.
std::string band(double x0, double y0, double x1, double y1, double height, const std::string& color) {
  const double middle = 0.5 * (x0 + x1);
  return fmt::format(
      "<path class=\"flow {}\" d=\"M{:.1f} {:.1f}C{:.1f} {:.1f} {:.1f} {:.1f} {:.1f} {:.1f}V{:.1f}C{:.1f} {:.1f} "
      "{:.1f} {:.1f} {:.1f} {:.1f}Z\"/>",
      color, x0, y0, middle, y0, middle, y1, x1, y1, y1 + height, middle, y1 + height, middle, y0 + height, x0,
      y0 + height);
}

std::string node(double x, double y, double height, const std::string& color) {
  return fmt::format("<rect class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"{:.1f}\"/>\n", color, x, y,
                     kNode, height);
}

std::string label(double x, double y, const std::string& text, bool strong, const char* anchor = "start") {
  return fmt::format(
      "<text class=\"fi i-text\" x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\" text-anchor=\"{}\"{}>{}</text>\n", x, y,
      kText, anchor, strong ? " font-weight=\"600\"" : "", html_escape(text));
}

class Flow {
 public:
  Flow(const EnergyRows& account, std::size_t report) : account_(account), report_(report) {}

  void branch(const Branch& branch) {
    const double height = thickness(branch.share());
    if (!branch.forked()) {
      leaf(branch.leaves.front(), kColumns[0] + kNode, source_);
      return advance(height);
    }
    const double last = branch.leaves.back().top + thickness(branch.leaves.back().share);
    const double y = std::max(0.5 * (branch.leaves.front().top + last - height), fork_);
    fork_ = y + height + kPitch;
    const std::string color = branch.fate == Fate::side ? "f-side" : "f-absorbed";
    svg_ += "<g>" + band(kColumns[0] + kNode, source_, kColumns[1], y, height, color) + "</g>\n";
    svg_ += node(kColumns[1], y, height, color);
    double from = y;
    for (const Leaf& one : branch.leaves) {
      leaf(one, kColumns[1] + kNode, from);
      from += thickness(one.share);
    }
    const std::string name = branch.fate == Fate::side ? "sides " : "absorbed ";
    const std::string text = name + rounded(100.0 * branch.share(), 3) + "\u00a0%";
    svg_ += label(kColumns[1] - 6.0, y + 0.5 * height + 0.35 * kText, text, false, "end");
    advance(height);
    bottom_ = std::max(bottom_, y + height);
  }

  double bottom() const { return std::max(bottom_, source_); }
  double source_height() const { return source_ - kTop; }
  const std::string& svg() const { return svg_; }

 private:
  void advance(double height) { source_ += height; }

  void leaf(const Leaf& leaf, double x, double from) {
    const Destination& row = account_.rows()[leaf.row];
    const std::string color = energy_class(leaf.row);
    const double height = thickness(leaf.share);
    const std::string text = percent(*row.shares[report_]);
    svg_ += "<g><title>" + html_escape(row.label + ": " + text) + "</title>" +
            band(x, from, kColumns[2], leaf.top, height, color) + node(kColumns[2], leaf.top, height, color) +
            label(kColumns[2] + kNode + 6.0, leaf.top + 0.5 * height + 0.35 * kText,
                  text + "  " + short_label(row.label), row.fate == Fate::top) +
            "</g>\n";
    bottom_ = std::max(bottom_, leaf.top + std::max(height, kPitch));
  }

  /// The name alone: the branch has told that it is absorbed.
  static std::string short_label(const std::string& text) {
    constexpr std::string_view prefix = "absorbed: ";
    std::string name = text.rfind(prefix, 0) == 0 ? text.substr(prefix.size()) : text;
    constexpr std::size_t kMost = 21;
    if (name.size() > kMost) name = clean_utf8(std::string_view(name).substr(0, kMost - 1)) + "\u2026";
    return name;
  }

  const EnergyRows& account_;
  std::size_t report_;
  double source_ = kTop;  ///< where the next branch leaves the source
  double fork_ = kTop;    ///< where the next fork may begin
  double bottom_ = kTop;
  std::string svg_;
};

}  // namespace

std::string energy_flow(const EnergyRows& account, std::size_t report, double emitted_lm) {
  Flow flow(account, report);
  for (const Branch& branch : branches_of(account, report)) flow.branch(branch);
  return fmt::format(
      "<svg class=\"energy\" viewBox=\"0 0 {} {:.0f}\" role=\"img\" aria-label=\"flow of the light from the LEDs to "
      "where it ends, as in the table\">\n{}{}{}</svg>\n",
      kWidth, flow.bottom() + 8.0, label(0.0, 13.0, "emitted " + rounded(emitted_lm) + " lm = 100\u00a0%", true),
      node(kColumns[0], kTop, flow.source_height(), "f-source"), flow.svg());
}

}  // namespace evenglow::design
