#include <utility>

#include "core/config/config_node_impl.h"
#include "core/config/config_state.h"
#include "core/config/includes.h"
#include "core/config/message_text.h"
#include "core/config/text_file.h"
#include "core/config/yaml_reader.h"

namespace evenglow::core {
namespace {

constexpr std::size_t kMaxFaultsTold = 100;

std::unique_ptr<ConfigState> parsed(std::string text, std::string name, std::filesystem::path folder) {
  require_text(text, name);
  auto state = std::make_unique<ConfigState>();
  state->file = std::make_shared<const std::string>(std::move(name));
  state->folder = std::move(folder);
  std::vector<Fault> faults;
  state->root = read_yaml(text, {state->file, "", true}, faults);
  if (!state->root) throw ConfigError(std::move(faults));
  state->note(faults);
  const ConfigValue& root = *state->root;
  if (root.kind == ConfigValue::Kind::kNull) {
    throw ConfigError(Fault{one_line(*state->file), 0, 0, "", "must hold a map of keys, got an empty file"});
  }
  if (!root.is_map()) {
    throw ConfigError(Fault{one_line(*state->file), root.place.line, root.place.column, "",
                            "must hold a map of keys (`key: value`), got " + described(root)});
  }
  expand_includes(*state, *state->root, "", state->folder);
  state->text = std::move(text);
  return state;
}

}  // namespace

ConfigDocument::ConfigDocument(std::unique_ptr<ConfigState> state) : state_(std::move(state)) {}
ConfigDocument::ConfigDocument(ConfigDocument&&) noexcept = default;
ConfigDocument& ConfigDocument::operator=(ConfigDocument&&) noexcept = default;
ConfigDocument::~ConfigDocument() = default;

ConfigDocument ConfigDocument::load(const std::filesystem::path& file) {
  return ConfigDocument(parsed(read_text_file(file, kMaxRunFileBytes), file.string(), file.parent_path()));
}

ConfigDocument ConfigDocument::parse(std::string text, std::string name) {
  if (text.size() > kMaxRunFileBytes) {
    throw ConfigError(Fault{one_line(name), 0, 0, "", "must not be larger than 8 MiB"});
  }
  std::filesystem::path folder = std::filesystem::path(name).parent_path();
  return ConfigDocument(parsed(std::move(text), std::move(name), std::move(folder)));
}

ConfigNode ConfigDocument::root() const {
  auto impl = std::make_shared<ConfigNode::Impl>();
  impl->state = state_.get();
  impl->value = state_->root.get();
  impl->place = impl->value->place;
  return ConfigNode(std::move(impl));
}

const std::string& ConfigDocument::name() const {
  return *state_->file;
}

const std::string& ConfigDocument::source_text() const {
  return state_->text;
}

const std::filesystem::path& ConfigDocument::folder() const {
  return state_->folder;
}

const std::vector<std::filesystem::path>& ConfigDocument::files() const {
  return state_->files;
}

const std::vector<DeclaredKey>& ConfigDocument::declared() const {
  return state_->declared;
}

const std::vector<MentionedKey>& ConfigDocument::mentioned() const {
  return state_->mentioned;
}

void ConfigDocument::finish() const {
  std::vector<Fault> faults = all_faults(*state_);
  if (faults.empty()) return;
  if (faults.size() > kMaxFaultsTold) {
    const std::string more = "and " + std::to_string(faults.size() - kMaxFaultsTold) + " more faults";
    faults.resize(kMaxFaultsTold);
    faults.push_back({one_line(name()), 0, 0, "", more});
  }
  throw ConfigError(std::move(faults));
}

}  // namespace evenglow::core
