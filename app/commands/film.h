#pragma once

#include <memory>
#include <vector>

namespace CLI {
class App;
}

namespace evenglow::app {

struct Session;

/// One command of the group `evenglow film`: it owns the values of its options.
class FilmCommand {
 public:
  virtual ~FilmCommand() = default;
  /// Adds the options, bound to members; called once, before the command line is read.
  virtual void add_options(CLI::App& command) = 0;
  /// Returns the exit code; wrong input leaves as `core::ConfigError`. Called at most once, after the command line was
  /// read.
  virtual int run(const Session& session) = 0;
};

std::unique_ptr<FilmCommand> make_film_reconstruct();
std::unique_ptr<FilmCommand> make_film_check();
std::unique_ptr<FilmCommand> make_film_convert();
std::unique_ptr<FilmCommand> make_film_goniometer();
std::unique_ptr<FilmCommand> make_film_fit();
std::unique_ptr<FilmCommand> make_film_sweep();

/// `evenglow film ...`: readings, tables and measurements of polarizing films.
class FilmGroup {
 public:
  FilmGroup() = default;
  FilmGroup(const FilmGroup&) = delete;
  FilmGroup& operator=(const FilmGroup&) = delete;

  /// Adds the group to the program. The group must stay where it is until the program is done.
  void add_to(CLI::App& program);
  /// The command that was chosen; null if it was none of this group.
  FilmCommand* chosen() const { return chosen_; }

 private:
  std::vector<std::unique_ptr<FilmCommand>> commands_;
  FilmCommand* chosen_ = nullptr;
};

}  // namespace evenglow::app
