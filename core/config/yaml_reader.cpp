#include "core/config/yaml_reader.h"

#include <optional>
#include <sstream>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include "core/config/key_path.h"
#include "core/config/message_text.h"
#include "core/config/yaml_frame.h"
#include "core/config/yaml_hints.h"
#include "core/config/yaml_limits.h"

namespace evenglow::core {
namespace {

/// Thrown through the parser once the fault that ends the reading is noted.
struct Stop {};
constexpr const char* kQuoteHint = " (within { } a key or text that holds [ ] { } or , must be quoted)";

/// Builds the tree from the parser's events. Depth and number of values are checked as they come, so that neither
/// nesting nor aliases can cost more than the limits.
class TreeBuilder final : public YAML::EventHandler {
 public:
  TreeBuilder(const std::string& text, const YamlSource& source, std::vector<Fault>& faults)
      : text_(text), source_(source), faults_(faults) {}

  std::unique_ptr<ConfigValue> take() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ == 1) return;
    const bool marked = mark.pos >= 0 && text_.compare(static_cast<std::size_t>(mark.pos), 3, "---") == 0;
    stop(place(mark), marked ? "must hold one YAML document, got a second one" : "not valid YAML: text after the end");
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    finish_value(new_value(ConfigValue::Kind::kNull, mark, 0), anchor);
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = anchors_.find(anchor);
    if (found == anchors_.end()) stop(place(mark), "an alias must not stand inside the value that it names");
    const ConfigExtent extent = extent_of(*found->second);
    check_depth(mark, static_cast<int>(frames_.size()) + extent.depth);
    count(mark, extent.values, extent.bytes);
    finish_value(copy_of(*found->second), 0);
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    auto scalar = new_value(ConfigValue::Kind::kScalar, mark, value.size());
    scalar->text = value;
    scalar->quoted = tag != "?";
    if (scalar->quoted) last_quoted_ = mark;
    check_tag(mark, tag);
    finish_value(std::move(scalar), anchor);
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value /*style*/) override {
    open(ConfigValue::Kind::kList, mark, tag, anchor);
  }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value /*style*/) override {
    open(ConfigValue::Kind::kMap, mark, tag, anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapEnd() override { close(); }

  ConfigPlace place(const YAML::Mark& mark) const {
    if (!source_.located || mark.is_null()) return {source_.file, 0, 0};
    return {source_.file, mark.line + 1, mark.column + 1};
  }

  /// A bracket that is never closed is shown itself, not the end of the text.
  ConfigPlace place_of_error(const YAML::Exception& error) const {
    const bool at_end = error.mark.pos >= 0 && static_cast<std::size_t>(error.mark.pos) >= text_.size();
    const bool unclosed = error.msg == YAML::ErrorMsg::END_OF_MAP_FLOW || error.msg == YAML::ErrorMsg::END_OF_SEQ_FLOW;
    return at_end && unclosed && !frames_.empty() ? frames_.back().value->place : place(error.mark);
  }

  /// To be called at the end of the text.
  void check_last_quote() {
    if (last_quoted_.is_null() || !is_open_quote(text_, static_cast<std::size_t>(last_quoted_.pos))) return;
    stop(place(last_quoted_), "not valid YAML: the quote that opens here is never closed");
  }

  /// Notes a fault after which the reading goes on, unless there are very many.
  void tolerate(const ConfigPlace& at, const std::string& message, const std::string& key) {
    note(at, message, key);
    if (++tolerated_ >= kMaxYamlFaults) stop(at, "too many faults, the reading ends here");
  }

  void note(const ConfigPlace& at, const std::string& message, const std::string& key) {
    faults_.push_back({one_line(*at.file), at.line, at.column, one_line(key), one_line(message)});
  }

 private:
  [[noreturn]] void stop(const ConfigPlace& at, const std::string& message) {
    note(at, message, source_.path);
    throw Stop{};
  }

  void check_depth(const YAML::Mark& mark, int depth) {
    if (depth > kMaxConfigDepth) stop(place(mark), kTooDeep);
  }

  void count(const YAML::Mark& mark, std::size_t values, std::size_t bytes) {
    values_ += values;
    bytes_ += bytes;
    if (values_ > kMaxConfigValues) stop(place(mark), kTooManyValues);
    if (bytes_ > kMaxRunFileBytes) stop(place(mark), kTooMuchText);
  }

  void check_tag(const YAML::Mark& mark, const std::string& tag) {
    // "?" stands for a plain value, "!" for one in quotes.
    if (tag.empty() || tag == "?" || tag == "!") return;
    tolerate(place(mark), "tags are not allowed, got " + shown(tag), path());
  }

  std::unique_ptr<ConfigValue> new_value(ConfigValue::Kind kind, const YAML::Mark& mark, std::size_t bytes) {
    count(mark, 1, bytes);
    auto value = std::make_unique<ConfigValue>();
    value->kind = kind;
    value->place = place(mark);
    return value;
  }

  void open(ConfigValue::Kind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    check_depth(mark, static_cast<int>(frames_.size()) + 1);
    check_tag(mark, tag);
    frames_.push_back({new_value(kind, mark, 0), anchor});
  }

  void close() {
    YamlFrame frame = std::move(frames_.back());
    frames_.pop_back();
    finish_value(std::move(frame.value), frame.anchor);
  }

  void finish_value(std::unique_ptr<ConfigValue> value, YAML::anchor_t anchor) {
    if (anchor != 0) anchors_[anchor] = value.get();
    if (frames_.empty()) {
      root_ = std::move(value);
    } else if (frames_.back().value->is_list()) {
      const ConfigPlace at = value->place;
      frames_.back().value->children.push_back({"", at, std::move(value)});
    } else if (!frames_.back().key) {
      take_key(std::move(value));
    } else {
      take_entry(std::move(value));
    }
  }

  void take_key(std::unique_ptr<ConfigValue> value) {
    const bool merge = value->is_scalar() && value->text == "<<" && !value->quoted;
    PendingKey key{value->text, value->place, value->is_scalar() && !merge};
    if (merge) {
      tolerate(key.place, "merge keys (<<) are not supported, write the keys out or alias a whole value", path());
    } else if (!key.usable) {
      tolerate(key.place, "a key must be a word, got " + described(*value), path());
    }
    frames_.back().key = std::move(key);
    unused_.push_back(std::move(value));
  }

  void take_entry(std::unique_ptr<ConfigValue> value) {
    YamlFrame& frame = frames_.back();
    const PendingKey key = *frame.key;
    if (value->kind == ConfigValue::Kind::kNull) value->place = key.place;
    const auto [first, fresh] = frame.lines.try_emplace(key.usable ? key.text : "", key.place.line);
    if (key.usable && !fresh) {
      const std::string where = first->second > 0 ? fmt::format(", first in line {}", first->second) : "";
      tolerate(key.place, "a key must not be given twice" + where, path());
    }
    frame.key.reset();
    if (key.usable && fresh) {
      frame.value->children.push_back({key.text, key.place, std::move(value)});
    } else {
      unused_.push_back(std::move(value));
    }
  }

  /// Of the value that is being read.
  std::string path() const {
    std::string result = source_.path;
    for (const YamlFrame& frame : frames_) {
      if (frame.value->is_list()) {
        result = item_path(result, frame.value->children.size());
      } else if (frame.key && frame.key->usable) {
        result = key_path(result, frame.key->text);
      }
    }
    return result;
  }

  const std::string& text_;
  const YamlSource& source_;
  std::vector<Fault>& faults_;
  int documents_ = 0;
  YAML::Mark last_quoted_ = YAML::Mark::null_mark();
  std::size_t values_ = 0;  ///< so far, aliases followed
  std::size_t bytes_ = 0;
  std::size_t tolerated_ = 0;
  std::vector<YamlFrame> frames_;
  std::unordered_map<YAML::anchor_t, const ConfigValue*> anchors_;  ///< of finished values
  std::vector<std::unique_ptr<ConfigValue>> unused_;                ///< not in the tree, but an alias may name them
  std::unique_ptr<ConfigValue> root_;
};

}  // namespace

std::unique_ptr<ConfigValue> read_yaml(const std::string& text, const YamlSource& source, std::vector<Fault>& faults) {
  TreeBuilder builder(text, source, faults);
  if (const std::string trouble = trouble_for_parser(text); !trouble.empty()) {
    builder.note({source.file, 0, 0}, trouble, source.path);
    return nullptr;
  }
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
    builder.check_last_quote();
  } catch (const Stop&) {
    return nullptr;
  } catch (const YAML::Exception& error) {
    const std::string hint =
        error.msg == YAML::ErrorMsg::END_OF_MAP_FLOW ? kQuoteHint : indentation_hint(text, error.mark.line);
    builder.note(builder.place_of_error(error), "not valid YAML: " + error.msg + hint, source.path);
    return nullptr;
  }
  auto root = builder.take();
  if (root) return root;
  root = std::make_unique<ConfigValue>();
  root->place.file = source.file;
  return root;
}

}  // namespace evenglow::core
