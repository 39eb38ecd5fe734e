#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/config/key_declarations.h"

/// Located values of a run file.
///
/// A reader asks a node for its keys with a declaration (key, help, range, fallback) and gets a value in the units of
/// the program. A fault is noted, with its place, and the read goes on with the fallback (or with some value inside the
/// range), so that one pass finds all faults; `ConfigDocument::finish()` then throws them together, after adding one
/// for every key that nobody read. Readers must therefore not rely on a value being the one written in the file until
/// `finish()` has returned. A document and its nodes belong to one thread.
namespace evenglow::core {

class ConfigDocument;
struct ConfigChild;
struct ConfigState;

/// A value of the run file that knows its place. Cheap to copy; lives as long as its document. A node may stand for a
/// value that is not in the file ("absent"): reads from an absent map give the fallbacks, so that defaults have one
/// home.
class ConfigNode {
 public:
  bool present() const;
  bool is_map() const;
  bool is_list() const;
  bool has(std::string_view key) const;
  /// Whether the key holds a map (of keys that may be a word or a map).
  bool has_map(std::string_view key) const;
  const std::string& path() const;  ///< `backlight.films[1]`

  double number(const NumberKey& declaration) const;
  /// As `number`, but no value if the key is absent (the fallback is not used).
  std::optional<double> optional_number(const NumberKey& declaration) const;
  long long integer(const IntegerKey& declaration) const;
  /// An integer that may also be written as 20e6; else as `integer`.
  long long count(const IntegerKey& declaration) const;
  std::string text(const TextKey& declaration) const;
  bool boolean(const BoolKey& declaration) const;
  std::string choice(const ChoiceKey& declaration) const;
  /// The word that says which reader takes the rest of this map: as `choice`, but none if it is at fault or missing.
  /// Then the other keys of the map are not judged, as nobody knows which are right. (`choice` of a key named `kind`
  /// also ends the judging, but returns some option.)
  std::optional<std::string> kind(const ChoiceKey& declaration) const;
  std::vector<double> numbers(const NumbersKey& declaration) const;
  /// A list of words, each of the options, none twice.
  std::vector<std::string> choices(const ChoiceKey& declaration) const;
  /// Path of an existing regular file, taken relative to the run file's folder (so is a fallback; an empty fallback
  /// means no file and gives an empty path). Absent: the fallback, or a fault. After a fault: an empty path.
  std::filesystem::path file(const TextKey& declaration) const;
  /// The file `name` in the directory that the key names; else as `file`.
  std::filesystem::path file_in(const TextKey& declaration, std::string_view name) const;

  /// The map below `key`; absent if the key is (then `required` makes it a fault). Anything but a map is a fault.
  ConfigNode map(std::string_view key, std::string_view help, bool required = false) const;
  /// The maps of the list below `key`, in order; none if absent. Anything but a list of maps is a fault; a wrong item
  /// gives an absent node whose reads note no faults.
  std::vector<ConfigNode> maps(std::string_view key, std::string_view help, std::size_t max_count = 1000) const;
  /// Names and nodes of a map whose keys are free (variants), in file order; all count as read.
  std::vector<std::pair<std::string, ConfigNode>> entries() const;
  /// The items of this list, in order; none if it is no list.
  std::vector<ConfigNode> items() const;
  /// The value as one line of YAML (`{kind: lpp}`); empty if absent.
  std::string yaml() const;

  /// Notes a fault at this node, or at its key `key`: "what is allowed, got what" (the caller words it). A key whose
  /// value was refused already gets no second fault.
  void fault(std::string_view message) const;
  void fault_at(std::string_view key, std::string_view message) const;
  /// Notes the faults of something that the key names, the first 20 of them.
  void fault_at(std::string_view key, const std::vector<Fault>& faults) const;

  /// Runs `make` and, if it throws, notes the message of the `Error` or each fault of the `ConfigError` (of another
  /// file, say) as a fault of `key`.
  template <typename Make>
  auto guarded(std::string_view key, Make&& make) const -> std::optional<decltype(make())> {
    try {
      return make();
    } catch (const ConfigError& error) {
      fault_at(key, error.faults());
      return std::nullopt;
    } catch (const Error& error) {
      fault_at(key, error.what());
      return std::nullopt;
    }
  }

  /// Marks this node and all below as read (for parts that another reader takes, such as `variants`).
  void mark_read() const;

  struct Impl;

 private:
  friend class ConfigDocument;
  explicit ConfigNode(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  std::shared_ptr<const Impl> impl_;
};

/// A parsed run file with the overrides laid over it and the faults found so far.
/// Refuses (ConfigError): what cannot be read, more than 8 MiB, not YAML, more than one document, nesting deeper than
/// 64, more than 200,000 values or 8 MiB of text after aliases are followed, a top that is not a map. Noted for
/// `finish()`, as the rest can still be judged: a key given twice (the first counts), a tag, a merge key, a key that is
/// no word.
class ConfigDocument {
 public:
  /// A key path as in `--set` (`backlight.films[3].axis_deg`) with its value as YAML text and the word that names its
  /// origin in messages (`--set`, or `run.yaml:31:9` for a variant).
  struct Override {
    std::string path;
    std::string yaml;
    std::string origin;
    /// The value with its places, if it stands in a file (a variant); then `yaml` only shows it.
    std::shared_ptr<const ConfigChild> located{};
  };
  using Variant = std::pair<std::string, std::vector<Override>>;

  static ConfigDocument load(const std::filesystem::path& file);
  /// `name` serves messages and as the file's path for `folder()`.
  static ConfigDocument parse(std::string text, std::string name);

  ConfigDocument(ConfigDocument&&) noexcept;
  ConfigDocument& operator=(ConfigDocument&&) noexcept;
  ~ConfigDocument();

  /// Replaces or adds the value at a key path; the maps on the way are made if absent, a list index must exist
  /// (or be the next one). A map replaces a map whole. A fault in the path or value is noted. Nodes taken earlier may
  /// keep the old value.
  void apply(const Override& change);
  /// The entries of the map `variants` at the top, in file order: name and overrides. The values keep their place, and
  /// may be applied to another document. Names must be of letters, digits, `_`, `-` and `.`, and not begin with `.`.
  /// Marks `variants` as read.
  std::vector<Variant> variants() const;
  /// The points of the map `sweep` at the top, in their order: name and overrides. Its one key says how they are made:
  /// `grid` (key paths, each with a list of values: all combinations, the last key running fastest), `zip` (the same:
  /// the first values of all keys, the second ones, and so on) or `list` (maps of key paths, one for each point). The
  /// names tell the values that can be told in a few letters and are each of their own (`p03_haze-0.9_seed-2`); they
  /// sort in the order of the points. Empty without a sweep. Marks `sweep` as read.
  std::vector<Variant> sweep() const;
  ConfigNode root() const;
  const std::string& name() const;              ///< as given, for messages
  const std::string& source_text() const;       ///< the file as read
  const std::filesystem::path& folder() const;  ///< of the file; relative paths in it count from here

  /// The data files that the keys read so far name, in the order of the reads.
  const std::vector<std::filesystem::path>& files() const;

  /// Every key that readers have declared so far, each once per node pattern and kind, in the order of the first reads.
  const std::vector<DeclaredKey>& declared() const;
  /// Every key that readers have asked for with `has` so far.
  const std::vector<MentionedKey>& mentioned() const;

  /// Every key that was not read becomes a fault (with the nearest key that its reader knows); then throws all
  /// faults, if any, as one ConfigError, in the order of lines (the first 100 of them, and how many more there are).
  void finish() const;

 private:
  explicit ConfigDocument(std::unique_ptr<ConfigState> state);
  std::unique_ptr<ConfigState> state_;
};

}  // namespace evenglow::core
