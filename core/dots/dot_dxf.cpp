#include "core/dots/dot_dxf.h"

#include <charconv>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/config/message_text.h"
#include "core/config/text_file.h"

namespace evenglow::core {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{512} << 20;
constexpr std::size_t kMaxDots = 20'000'000;
constexpr double kFar = 1e5;  // mm

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r')) text.remove_suffix(1);
  return text;
}

/// The group codes of one entity that count here.
struct Entity {
  std::string_view type, name;
  double x = 0.0, y = 0.0, radius = 0.0, scale_x = 1.0, scale_y = 1.0, turn = 0.0, z_axis = 1.0;
  double columns = 1.0, rows = 1.0;
  int line = 0;
};

struct Circle {
  double x, y, radius;
};

class Reader {
 public:
  Reader(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  DxfDots run() {
    int code = 0;
    std::string_view value;
    while (next(code, value)) take(code, value);
    finish_entity();
    if (result_.dots.empty())
      refuse(0, fmt::format("must hold at least one circle, got none among {} other entities", result_.ignored));
    return std::move(result_);
  }

 private:
  [[noreturn]] void refuse(int line, std::string message) const {
    throw ConfigError(Fault{one_line(name_), line, 0, "", std::move(message)});
  }

  std::string_view next_line() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    const std::string_view line = text_.substr(at_, end - at_);
    at_ = end + 1;
    ++line_;
    return trimmed(line);
  }

  bool next(int& code, std::string_view& value) {
    if (at_ >= text_.size()) return false;
    const std::string_view first = next_line();
    if (first.empty() && at_ >= text_.size()) return false;
    const auto [end, error] = std::from_chars(first.data(), first.data() + first.size(), code);
    if (error != std::errc() || end != first.data() + first.size())
      refuse(line_, fmt::format("must be a group code of an ASCII DXF file, got \"{}\"", shown(first, 40)));
    if (at_ >= text_.size()) refuse(line_, "must be followed by a value, got the end of the file");
    value = next_line();
    return true;
  }

  double number(std::string_view text) const {
    double value = 0.0;
    if (text.starts_with('+')) text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
      refuse(line_, fmt::format("must be a number, got \"{}\"", shown(text, 40)));
    return value;
  }

  void take(int code, std::string_view value) {
    if (code == 0) {
      finish_entity();
      entity_ = {};
      entity_.type = value;
      entity_.line = line_;
      if (value == "ENDSEC") section_ = {};
      if (value == "ENDBLK") block_ = nullptr;
      return;
    }
    if (code == 2 && entity_.type == "SECTION") section_ = value;
    if (code == 9) variable_ = value;
    if (section_ == "HEADER") {
      if (code == 70 && variable_ == "$INSUNITS") set_unit(number(value));
      return;
    }
    if (section_ != "ENTITIES" && section_ != "BLOCKS") return;
    if (entity_.type != "CIRCLE" && entity_.type != "INSERT" && entity_.type != "BLOCK") return;
    switch (code) {
      case 2:
        entity_.name = value;
        break;
      case 10:
        entity_.x = number(value);
        break;
      case 20:
        entity_.y = number(value);
        break;
      case 40:
        entity_.radius = number(value);
        break;
      case 41:
        entity_.scale_x = number(value);
        break;
      case 42:
        entity_.scale_y = number(value);
        break;
      case 50:
        entity_.turn = number(value) * kRadPerDeg;
        break;
      case 70:
        if (entity_.type == "INSERT") entity_.columns = number(value);
        break;
      case 71:
        if (entity_.type == "INSERT") entity_.rows = number(value);
        break;
      case 230:
        entity_.z_axis = number(value);
        break;
      default:
        break;
    }
  }

  void set_unit(double code) {
    if (code == 0.0 || code == 4.0) return;
    if (code == 1.0)
      unit_ = 25.4;
    else if (code == 5.0)
      unit_ = 10.0;
    else if (code == 6.0)
      unit_ = 1000.0;
    else if (code == 13.0)
      unit_ = 1e-3;
    else
      refuse(line_,
             fmt::format("$INSUNITS must be 0 (mm), 1 (inch), 4 (mm), 5 (cm), 6 (m) or 13 (um), got {:g}", code));
  }

  void finish_entity() {
    const Entity& e = entity_;
    if (e.type == "BLOCK") {
      block_ = &blocks_[std::string(e.name)];
      base_x_ = e.x;
      base_y_ = e.y;
    } else if (e.type == "CIRCLE" && section_ == "BLOCKS" && block_ != nullptr) {
      check_circle(e);
      block_->push_back({e.x - base_x_, e.y - base_y_, e.radius});
    } else if (e.type == "CIRCLE" && section_ == "ENTITIES") {
      check_circle(e);
      add(e.z_axis < 0.0 ? -e.x : e.x, e.y, e.radius, 0.0);
    } else if (e.type == "INSERT" && section_ == "ENTITIES") {
      insert(e);
    } else if (section_ == "ENTITIES" && e.type != "SECTION" && e.type != "ENDSEC" && e.type != "VERTEX" &&
               e.type != "SEQEND") {
      ++result_.ignored;
    }
    entity_.type = {};
  }

  void check_circle(const Entity& e) const {
    if (!(e.radius > 0.0)) refuse(e.line, fmt::format("a circle must have a radius above 0, got {:g}", e.radius));
  }

  void insert(const Entity& e) {
    const auto block = blocks_.find(std::string(e.name));
    if (block == blocks_.end())
      refuse(e.line, fmt::format("must name a block of the file, got \"{}\"", shown(e.name, 40)));
    if (block->second.empty()) {
      ++result_.ignored;
      return;
    }
    if (std::abs(std::abs(e.scale_x) - std::abs(e.scale_y)) > 1e-9 || e.scale_x == 0.0 || e.columns > 1.0 ||
        e.rows > 1.0)
      refuse(e.line, fmt::format("a block of circles must be scaled alike in x and y and stand alone, got {:g} x {:g}",
                                 e.scale_x, e.scale_y));
    const double cos_t = std::cos(e.turn), sin_t = std::sin(e.turn);
    for (const Circle& c : block->second) {
      const double x = c.x * e.scale_x, y = c.y * e.scale_y;
      add(e.x + x * cos_t - y * sin_t, e.y + x * sin_t + y * cos_t, c.radius * std::abs(e.scale_x), e.turn);
    }
  }

  void add(double x, double y, double radius, double angle) {
    if (result_.dots.size() >= kMaxDots) refuse(line_, fmt::format("must hold at most {} circles", kMaxDots));
    if (std::abs(x * unit_) > kFar || std::abs(y * unit_) > kFar || radius * unit_ > 100.0 || radius * unit_ < 5e-6)
      refuse(line_, fmt::format("a dot must lie within 100 m and have a radius from 0.005 um to 100 mm, got radius "
                                "{:g} mm at {:g}, {:g} mm",
                                radius * unit_, x * unit_, y * unit_));
    result_.dots.push_back({x * unit_, y * unit_, static_cast<float>(radius * unit_), static_cast<float>(angle)});
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
  int line_ = 0;
  std::string_view section_, variable_;
  Entity entity_;
  std::map<std::string, std::vector<Circle>> blocks_;
  std::vector<Circle>* block_ = nullptr;
  double base_x_ = 0.0, base_y_ = 0.0;
  double unit_ = 1.0;
  DxfDots result_;
};

}  // namespace

DxfDots parse_dot_dxf(std::string_view text, const std::string& name) {
  return Reader(text, name).run();
}

DxfDots read_dot_dxf(const std::filesystem::path& file) {
  const std::string text = read_text_file(file, kMaxBytes);
  if (text.starts_with("AutoCAD Binary DXF"))
    throw ConfigError(Fault{one_line(file.string()), 0, 0, "", "must be an ASCII DXF file, got a binary one"});
  return parse_dot_dxf(text, file.string());
}

}  // namespace evenglow::core
