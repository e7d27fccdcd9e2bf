// Owns how commands state what they understand: names, options, help. The only user of the library that reads them.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "results/course/options.h"

namespace CLI {
class App;
}

namespace beltlife {

/// The whole numbers that an option takes.
struct WholeNumbers {
  double lowest = 0, highest = 9e15;
};

/// One command, while it says what it understands. References must live until it has run: options belong to the
/// function that runs (see runs()). Each option returns the command, so that they can be said one after the other.
class Command {
 public:
  /// A command inside this one (`study noise`); one of them has to be named.
  Command command(const std::string& name, const std::string& about);

  /// What stands without a flag; required.
  Command& input(const std::string& name, std::string& value, const std::string& about);
  Command& inputs(const std::string& name, std::vector<std::string>& values, const std::string& about);
  Command& inputs_or_none(const std::string& name, std::vector<std::string>& values, const std::string& about,
                          const std::string& type);

  Command& flag(const std::string& name, bool& value, const std::string& about);
  /// A name of a file and the like: an empty one, which comes from a shell variable that is not set, is refused.
  Command& text(const std::string& name, std::string& value, const std::string& type, const std::string& about);
  /// Repeatable.
  Command& texts(const std::string& name, std::vector<std::string>& values, const std::string& type,
                 const std::string& about);
  /// Stands for --set SETTING=value.
  Command& stands_for(const std::string& name, const std::string& setting, std::vector<std::string>& settings,
                      const std::string& about);
  /// A whole number. `value` may be optional.
  template <class T>
  Command& whole(const std::string& name, T& value, WholeNumbers allowed, const std::string& about);
  Command& required_whole(const std::string& name, std::size_t& value, WholeNumbers allowed, const std::string& about);
  Command& positive(const std::string& name, double& value, const std::string& type, const std::string& about);
  /// Prints a text and ends the program.
  Command& prints(const std::string& name, std::function<std::string()> text, const std::string& about);

  /// The two flags cannot be given together.
  Command& excludes(const std::string& one, const std::string& other);
  Command& footer(const std::string& text);
  /// Its points may be spread over processes by mpirun; other commands refuse to be started that way.
  Command& spreads_over_processes();

  /// What the command does; the returned number is the exit code. `options` are the references above.
  template <class Options>
  void runs(std::shared_ptr<Options> options, int (*run)(const Options&)) {
    runs_with([options, run](const Program& program, bool spreads) {
      if constexpr (std::is_base_of_v<CommonOptions, Options>) take_program(*options, program, spreads);
      return run(*options);
    });
  }

 private:
  friend class CommandLine;
  using Chosen = std::function<int(const Program&, bool spreads)>;
  struct State {
    Chosen run;            ///< of the command that was given
    bool spreads = false;  ///< whether that one spreads its points
  };
  Command(CLI::App& app, State& state) : app_(&app), state_(&state) {}
  void whole_number(const std::string& name, std::function<void(double)> take, WholeNumbers allowed,
                    const std::string& about, bool required);
  void runs_with(Chosen run);
  static void take_program(CommonOptions& options, const Program& program, bool spreads);

  CLI::App* app_;
  State* state_;
  bool spreads_ = false;
};

/// The command line of the program.
class CommandLine {
 public:
  /// `about`: what the program is, for --help; `footer` stands below its list of commands.
  CommandLine(const Program& program, const std::string& about, const std::string& footer);
  ~CommandLine();
  Command command(const std::string& name, const std::string& about);
  /// Of the program itself.
  Command& top() { return top_; }

  /// Reads the command line and runs the command; the exit code. Throws what the command throws.
  int run(int argc, char** argv);

 private:
  Program program_;
  std::unique_ptr<CLI::App> app_;
  Command::State state_;
  Command top_;
};

template <class T>
Command& Command::whole(const std::string& name, T& value, WholeNumbers allowed, const std::string& about) {
  whole_number(
      name,
      [&value](double number) {
        if constexpr (std::is_arithmetic_v<T>)
          value = static_cast<T>(number);
        else
          value = static_cast<typename T::value_type>(number);
      },
      allowed, about, false);
  return *this;
}

}  // namespace beltlife
