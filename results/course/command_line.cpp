// Reading of the command line: see command_line.h.
#include "results/course/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>

#include "results/journal/ranks.h"
#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

/// Says what is allowed in words; CLI11's own bounds print as the largest double.
CLI::Validator number_where(std::function<bool(double)> allowed, const std::string& words) {
  return CLI::Validator(
      [allowed = std::move(allowed), words](const std::string& text) {
        double value = 0;
        const bool fits = CLI::detail::lexical_cast(text, value) && allowed(value);
        return fits ? std::string() : "\"" + text + "\" is not " + words;
      },
      "");
}

CLI::Validator not_empty() {
  return CLI::Validator([](const std::string& text) { return std::string(text.empty() ? "names no file" : ""); }, "");
}

std::string spelt(double bound) {
  return bound >= 1e6 ? fmt::format("{:g}e15", bound / 1e15) : fmt::format("{}", bound);
}

}  // namespace

Command Command::command(const std::string& name, const std::string& about) {
  app_->require_subcommand(1);
  return {*app_->add_subcommand(name, about), *state_};
}

Command& Command::input(const std::string& name, std::string& value, const std::string& about) {
  // Not a list: a positional that takes several would swallow the value of a flag that does not exist.
  app_->add_option(name, value, about)->required();
  return *this;
}

Command& Command::inputs(const std::string& name, std::vector<std::string>& values, const std::string& about) {
  app_->add_option(name, values, about)->required()->expected(1, -1);
  return *this;
}

Command& Command::inputs_or_none(const std::string& name, std::vector<std::string>& values, const std::string& about,
                                 const std::string& type) {
  app_->add_option(name, values, about)->type_name(type);
  return *this;
}

Command& Command::flag(const std::string& name, bool& value, const std::string& about) {
  app_->add_flag(name, value, about);
  return *this;
}

Command& Command::text(const std::string& name, std::string& value, const std::string& type, const std::string& about) {
  app_->add_option(name, value, about)->type_name(type)->check(not_empty());
  return *this;
}

Command& Command::texts(const std::string& name, std::vector<std::string>& values, const std::string& type,
                        const std::string& about) {
  app_->add_option(name, values, about)->type_name(type)->take_all()->expected(1);
  return *this;
}

Command& Command::stands_for(const std::string& name, const std::string& setting, std::vector<std::string>& settings,
                             const std::string& about) {
  app_->add_option_function<std::string>(
      name, [&settings, setting](const std::string& value) { settings.push_back(setting + "=" + value); },
      about + " (same as --set " + setting + "=...)");
  return *this;
}

void Command::whole_number(const std::string& name, std::function<void(double)> take, WholeNumbers allowed,
                           const std::string& about, bool required) {
  const auto fits = [allowed](double n) { return n >= allowed.lowest && n <= allowed.highest && n == std::floor(n); };
  app_->add_option_function<double>(name, std::move(take), about)
      ->type_name("N")
      ->required(required)
      ->check(number_where(fits, "a whole number from " + spelt(allowed.lowest) + " to " + spelt(allowed.highest)));
}

Command& Command::required_whole(const std::string& name, std::size_t& value, WholeNumbers allowed,
                                 const std::string& about) {
  whole_number(
      name, [&value](double number) { value = static_cast<std::size_t>(number); }, allowed, about, true);
  return *this;
}

Command& Command::positive(const std::string& name, double& value, const std::string& type, const std::string& about) {
  app_->add_option(name, value, about)
      ->type_name(type)
      ->check(number_where([](double n) { return n > 0 && std::isfinite(n); }, "a finite number above 0"));
  return *this;
}

Command& Command::prints(const std::string& name, std::function<std::string()> text, const std::string& about) {
  app_->add_flag_callback(
          name,
          [text = std::move(text)] {
            std::cout << text();
            throw CLI::Success();
          },
          about)
      ->trigger_on_parse();
  return *this;
}

Command& Command::excludes(const std::string& one, const std::string& other) {
  app_->get_option(one)->excludes(app_->get_option(other));
  return *this;
}

Command& Command::footer(const std::string& text) {
  app_->footer(text);
  return *this;
}

Command& Command::spreads_over_processes() {
  spreads_ = true;
  return *this;
}

void Command::runs_with(Chosen run) {
  app_->callback([state = state_, run = std::move(run), spreads = spreads_] {
    state->run = run;
    state->spreads = spreads;
  });
}

void Command::take_program(CommonOptions& options, const Program& program, bool spreads) {
  options.program = program;
  if (!program.ranks || !spreads) return;
  options.threads = program.ranks->threads(options.threads);
  options.quiet = options.quiet || !program.ranks->leads();
}

CommandLine::CommandLine(const Program& program, const std::string& about, const std::string& footer)
    : program_(program), app_(std::make_unique<CLI::App>(about)), top_(*app_, state_) {
  app_->set_version_flag("--version", program.version + " (" + program.revision + ")");
  app_->footer(footer);
}

CommandLine::~CommandLine() = default;

Command CommandLine::command(const std::string& name, const std::string& about) {
  return {*app_->add_subcommand(name, about), state_};
}

int CommandLine::run(int argc, char** argv) {
  app_->require_subcommand(0, 1);
  try {
    app_->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (program_.ranks && !program_.ranks->leads()) return 0;
    return app_->exit(error) == 0 ? 0 : 1;
  }
  if (!state_.run) {
    std::cerr << app_->help();
    return 1;
  }
  if (program_.ranks && !state_.spreads)
    throw BadInput({Problem{"mpirun", 0, "", "this command runs in one process", "study, calibrate, optimize"}});
  return state_.run(program_, state_.spreads);
}

}  // namespace beltlife
