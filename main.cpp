// The beltlife command: hands the command line to the commands and turns bad input into exit code 2.
#include <CLI/CLI.hpp>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <memory>

#include "calibrate/commands.h"
#include "calibrate/pages/calibrate_page.h"
#include "calibrate/twin.h"
#include "optimize/commands.h"
#include "optimize/pages/optimize_page.h"
#include "results/commands/commands.h"
#include "results/journal/ranks.h"
#include "sim/scene/scene_io.h"
#include "studies/commands.h"
#include "studies/pages.h"

namespace {

using beltlife::CommandOptions;

// Flags that stand for a setting, so that a scene and the command line meet in one place.
struct Shorthand {
  std::string scheme, step, elements;
};

// Says what is allowed in words; CLI11's own bounds print as the largest double.
CLI::Validator number_where(bool (*allowed)(double), const std::string& words) {
  return CLI::Validator(
      [allowed, words](const std::string& text) {
        double value = 0;
        const bool fits = CLI::detail::lexical_cast(text, value) && allowed(value);
        return fits ? std::string() : "\"" + text + "\" is not " + words;
      },
      "");
}

CLI::Validator whole_number_up_to_9e15() {
  return number_where([](double n) { return n >= 0 && n <= 9e15 && n == std::floor(n); },
                      "a whole number from 0 to 9e15");
}

// An empty file name comes from a shell variable that is not set; it does not mean "no file".
CLI::Validator not_empty() {
  return CLI::Validator([](const std::string& text) { return std::string(text.empty() ? "names no file" : ""); }, "");
}

void common_flags(CLI::App& app, CommandOptions& o, Shorthand& s) {
  app.add_option("--set", o.settings,
                 "change a scene field by path, e.g. --set tensioner.friction_torque_n_m=4 (repeatable)")
      ->type_name("PATH=VALUE")
      ->take_all()
      ->expected(1);
  app.add_option("--scheme", s.scheme,
                 "time integrator: linearly_implicit, symplectic_euler or thesis (same as --set solver.scheme=...)");
  app.add_option("--step", s.step, "time step in s (same as --set solver.step_s=...)");
  app.add_option("--elements", s.elements, "belt elements (same as --set belt.elements=...)");
  app.add_flag("--json", o.json, "print one JSON object on standard output");
  app.add_flag("--quiet", o.quiet, "no progress on standard error");
}

void threads_flag(CLI::App& app, CommandOptions& o, const std::string& about) {
  app.add_option("--threads", o.threads, about)
      ->type_name("N")
      ->check(number_where([](double n) { return n >= 0 && n <= 1024 && n == std::floor(n); },
                           "a whole number from 0 to 1024"));
}

void frames_flag(CLI::App& app, CommandOptions& o) {
  app.add_option("--frames", o.frames, "frames of the moving belt that --out keeps of every range; 0: none")
      ->type_name("N")
      ->check(number_where([](double n) { return n >= 0 && n <= 1000 && n == std::floor(n); },
                           "a whole number from 0 to 1000"));
}

void run_flags(CLI::App& app, CommandOptions& o) {
  app.add_option("--range", o.ranges, "only this operating range (repeatable)")
      ->type_name("NAME")
      ->take_all()
      ->expected(1);
  threads_flag(app, o, "threads over ranges, 0: all");
  app.add_flag("--force", o.force, "run with a step beyond the scheme's predicted limit");
  app.add_option("--out", o.out, "write an HDF5 result file; of several scenes FILE_SCENE.h5 each")
      ->type_name("FILE.h5")
      ->check(not_empty());
  frames_flag(app, o);
}

void driver_flags(CLI::App& app, CommandOptions& o, bool seeded) {
  threads_flag(app, o, "threads over points, 0: all");
  if (seeded)
    app.add_option("--seed", o.seed, "seed of whatever is drawn at random, instead of the file's")
        ->type_name("N")
        ->check(whole_number_up_to_9e15());
  app.add_option("--out", o.out, "HDF5 result file; its log stands beside it; by default named after the study file")
      ->type_name("FILE.h5")
      ->check(not_empty());
}

void fields_flag(CLI::App& app, std::string (*fields)()) {
  app.add_flag_callback(
         "--fields",
         [fields] {
           std::cout << fields();
           throw CLI::Success();
         },
         "print the reference of the file's fields as Markdown and exit")
      ->trigger_on_parse();
}

std::string joined(int argc, char** argv) {
  std::string line;
  for (int i = 0; i < argc; ++i) line += (i ? " " : "") + std::string(argv[i]);
  return line;
}

int run(int argc, char** argv, beltlife::Ranks* ranks) {
  CommandOptions o;
  Shorthand shorthand;
  o.version = BELTLIFE_VERSION;
  o.revision = BELTLIFE_REVISION;
  o.compiler = BELTLIFE_COMPILER;
  o.command_line = joined(argc, argv);

  CLI::App app{"beltlife: simulates poly-V belt drives in time and predicts how long the belt lives"};
  app.set_version_flag("--version", std::string(BELTLIFE_VERSION) + " (" + BELTLIFE_REVISION + ")");
  app.footer(
      "Examples:\n"
      "  beltlife check sim/scenes/baseline.toml\n"
      "  beltlife simulate sim/scenes/two_pulley.toml --each-range --out two_pulley.h5\n"
      "  beltlife life sim/scenes/baseline.toml --set belt.friction_front=0.5\n"
      "  beltlife optimize optimize/examples/small.toml\n"
      "Exit codes: 0 done, 1 usage, 2 bad input, 3 ran but failed, 4 a bug of ours.");

  CLI::App* check = app.add_subcommand(
      "check", "read a scene, solve its layout and static balance, print limits and names; runs nothing");
  CLI::App* modes = app.add_subcommand(
      "modes", "natural frequencies of every range, rotational and of the spans, and their crossings with orders");
  CLI::App* simulate = app.add_subcommand(
      "simulate",
      "run the profile, single ranges, a run-up or an event; print tensions, slip, hub loads, spectra and energy");
  CLI::App* life =
      app.add_subcommand("life", "run every range alone, in parallel, and print stresses and the life of the belt");
  for (CLI::App* command : {check, modes, simulate, life}) {
    common_flags(*command, o, shorthand);
    if (command != check && command != modes) run_flags(*command, o);
  }
  std::string scene;  // not the list: a vector positional would swallow the value of a flag that does not exist
  check->add_option("scene", scene, "scene file (TOML)")->required();
  check->footer("Example:\n  beltlife check sim/scenes/baseline.toml --json");
  modes->add_option("scene", scene, "scene file (TOML)")->required();
  CLI::Option* map =
      modes->add_option("--map", o.map, "also draw frequencies over crank speed with rays of orders (needs gnuplot)")
          ->type_name("FILE.svg")
          ->check(not_empty());
  modes->add_option("--range", o.ranges, "only this operating range, without crossings and map (repeatable)")
      ->type_name("NAME")
      ->take_all()
      ->expected(1)
      ->excludes(map);
  modes->footer(
      "Examples:\n"
      "  beltlife modes sim/scenes/baseline.toml\n"
      "  beltlife modes sim/scenes/baseline.toml --range B100\n"
      "  beltlife modes sim/scenes/accessory_drive.toml --map accessory.svg");
  simulate->add_option("scene", scene, "scene file (TOML)")->required();
  simulate->add_flag("--each-range", o.each_range, "every range alone, in parallel, instead of the profile");
  simulate->add_flag("--profile", o.profile, "print the time spent in each kernel");
  simulate
      ->add_option(
          "--sweep", o.sweep,
          "run through crank speeds, e.g. 600:2200:60 (r/min, r/min, s), and print the output's orders over them")
      ->type_name("FROM:TO:SECONDS")
      ->check(not_empty())
      ->excludes(simulate->get_option("--range"))
      ->excludes(simulate->get_option("--each-range"));
  simulate->footer(
      "Examples:\n"
      "  beltlife simulate sim/scenes/baseline.toml --range B100 --set profile.hold_s=1.5\n"
      "  beltlife simulate sim/scenes/accessory_drive.toml --each-range --json > accessory.json\n"
      "  beltlife simulate sim/scenes/baseline.toml --sweep 600:2200:60 --out sweep.h5\n"
      "  beltlife simulate sim/scenes/sudden_stop.toml");
  life->add_option("scene", o.scenes, "one or more scene files (TOML)")->required()->expected(1, -1);
  life->add_option("--details", o.details,
                   "also write tensions, slip, hub loads, orders and energy of every range to a text file")
      ->type_name("FILE.txt")
      ->check(not_empty());
  life->add_option("--flank-for", o.flank_for_life_h,
                   "also print the flank height at which the life is this many hours")
      ->type_name("HOURS")
      ->check(number_where([](double h) { return h > 0 && std::isfinite(h); }, "a finite number above 0"));
  life->footer(
      "Examples:\n"
      "  beltlife life sim/scenes/two_pulley.toml\n"
      "  beltlife life sim/scenes/baseline.toml sim/scenes/alternative_1.toml");

  CLI::App* report = app.add_subcommand(
      "report", "write one HTML page about a result file or a study, or about several result files side by side");
  report
      ->add_option("files", o.scenes,
                   "HDF5 result file (--out of simulate, life, study), or a study's log (.jsonl, .jsonl.gz); several "
                   "result files of simulate and life are compared")
      ->required()
      ->expected(1, -1);
  report->add_option("--out", o.out, "the page; by default beside the (first) file, ending in .html")
      ->type_name("FILE.html")
      ->check(not_empty());
  report->add_flag("--quiet", o.quiet, "do not say what was written");
  report->footer(
      "Examples:\n"
      "  beltlife simulate sim/scenes/two_pulley.toml --each-range --out two.h5 && beltlife report two.h5\n"
      "  beltlife report baseline.h5 alternative_1.h5    (writes baseline_vs_alternative_1.html)");

  CLI::App* export_ = app.add_subcommand("export", "list the datasets of a result or study file, or write them as CSV");
  export_->add_option("file", scene, "HDF5 file (--out of simulate, life, study, ...)")->required();
  export_
      ->add_option("datasets", o.datasets,
                   "datasets, or groups whose datasets are equally long, to stand side by side; without any they are "
                   "listed")
      ->type_name("DATASET");
  export_->add_option("--out", o.out, "write there instead of to standard output")
      ->type_name("FILE.csv")
      ->check(not_empty());
  export_->add_flag("--json", o.json, "the list as one JSON object");
  export_->add_flag("--quiet", o.quiet, "do not say what was written");
  export_->footer(
      "Examples:\n"
      "  beltlife export two.h5\n"
      "  beltlife export two.h5 runs/0/trace --out trace.csv\n"
      "  beltlife export two.h5 ranges/fast/spectra/frequency_hz ranges/fast/spectra/driven.speed_rpm");

  CLI::App* study = app.add_subcommand("study", "what moves a quantity, and how far it can be trusted");
  for (const beltlife::StudyKind& kind : beltlife::study_kinds()) {
    CLI::App* of_kind = study->add_subcommand(kind.name, kind.about);
    common_flags(*of_kind, o, shorthand);
    driver_flags(*of_kind, o, kind.seeded);
    of_kind->add_option("study", scene, "study file (TOML)")->required();
    fields_flag(*of_kind, kind.fields);
    of_kind->callback([&o, name = kind.name] { o.kind = name; });
    of_kind->footer("Example:\n  beltlife study " + kind.name + " studies/examples/" + kind.name +
                    ".toml\nA run that is stopped goes on with the same command. Fields of the file: beltlife study " +
                    kind.name + " --fields, or studies/README.md.");
  }
  study->require_subcommand(1);
  study->footer(
      "Examples:\n"
      "  beltlife study noise studies/examples/noise.toml\n"
      "  beltlife study oat studies/examples/oat.toml --out oat.h5 && beltlife report oat.h5\n"
      "  beltlife study sobol --fields");

  CLI::App* calibrate =
      app.add_subcommand("calibrate", "fit parameters to measured spectra or numbers, with intervals");
  common_flags(*calibrate, o, shorthand);
  driver_flags(*calibrate, o, false);
  calibrate->add_option("study", scene, "calibration file (TOML)")->required();
  fields_flag(*calibrate, beltlife::calibrate_fields);
  calibrate->footer(
      "Examples:\n"
      "  beltlife calibrate calibrate/examples/small.toml --set profile.hold_s=1 --set profile.evaluate_s=0.48\n"
      "  beltlife calibrate calibrate/examples/fine.toml --set profile.hold_s=1.5 --out fine.h5 && beltlife report "
      "fine.h5\n"
      "A run that is stopped goes on with the same command. Fields of the file: --fields, or calibrate/README.md.");

  CLI::App* optimize = app.add_subcommand("optimize", "search layouts for the longest life, within named clearances");
  common_flags(*optimize, o, shorthand);
  driver_flags(*optimize, o, true);
  optimize->add_option("study", scene, "search file (TOML)")->required();
  fields_flag(*optimize, beltlife::optimize_fields);
  optimize->footer(
      "Examples:\n"
      "  beltlife optimize optimize/examples/small.toml\n"
      "  beltlife optimize optimize/examples/thesis_quick.toml --out quick.h5 && beltlife report quick.h5\n"
      "A run that is stopped goes on with the same command. Fields of the file: --fields, or optimize/README.md.");

  CLI::App* twin = app.add_subcommand(
      "twin", "make records out of the model, with hidden parameters and noise, to try a calibration on");
  common_flags(*twin, o, shorthand);
  threads_flag(*twin, o, "threads over ranges, 0: all");
  twin->add_option("--seed", o.seed, "seed of the noise, instead of the file's")
      ->type_name("N")
      ->check(whole_number_up_to_9e15());
  twin->add_option("--out", o.out, "beginning of the files' names, PREFIX_RANGE.csv; by default the twin file's")
      ->type_name("PREFIX")
      ->check(not_empty());
  twin->add_option("twin", scene, "twin file (TOML)")->required();
  fields_flag(*twin, beltlife::twin_fields);
  twin->footer("Example:\n  beltlife twin calibrate/examples/small_twin.toml --out build/small");

  CLI::App* replay = app.add_subcommand("replay", "run one point of a study again, with full output");
  replay->add_option("file", scene, "log (.jsonl) or result file (.h5) of a study, calibration or search")->required();
  replay->add_option("--point", o.point, "number of the point, from 0")
      ->required()
      ->type_name("N")
      ->check(whole_number_up_to_9e15());
  replay->add_option("--out", o.out, "write an HDF5 result file, for beltlife report")
      ->type_name("FILE.h5")
      ->check(not_empty());
  frames_flag(*replay, o);
  replay->add_flag("--json", o.json, "print one JSON object on standard output");
  replay->add_flag("--quiet", o.quiet, "no progress on standard error");
  replay->footer("Example:\n  beltlife replay noise.jsonl --point 3 --out point3.h5 && beltlife report point3.h5");

  CLI::App* serve = app.add_subcommand(
      "serve", "answer other programs over UM-Bridge (HTTP and JSON): parameters in, quantities out");
  common_flags(*serve, o, shorthand);
  threads_flag(*serve, o, "threads over points, 0: all");
  serve->add_option("study", scene, "study file (TOML)")->required();
  serve->add_option("--port", o.port, "port to listen on, instead of the file's; 0: the system chooses one")
      ->type_name("N")
      ->check(number_where([](double n) { return n >= 0 && n <= 65535 && n == std::floor(n); },
                           "a whole number from 0 to 65535"));
  serve->add_option("--address", o.address, "address to listen on, instead of the file's (127.0.0.1)")
      ->type_name("A")
      ->check(not_empty());
  fields_flag(*serve, beltlife::serve_fields);
  serve->footer(
      "Examples:\n"
      "  beltlife serve results/examples/serve_small.toml\n"
      "  curl -d '{\"name\": \"beltlife\", \"input\": [[0.6, 600]]}' http://127.0.0.1:4242/Evaluate\n"
      "Ctrl-C stops it. Fields of the file: --fields; protocol, errors and limits: results/README.md.");

  bool reference = false;
  app.add_flag("--fields", reference, "print the reference of all scene fields as Markdown and exit");
  app.require_subcommand(0, 1);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (ranks && !ranks->leads()) return 0;
    return app.exit(error) == 0 ? 0 : 1;
  }
  if (reference) {
    std::cout << beltlife::field_reference();
    return 0;
  }
  if (*check || *modes || *simulate || *export_ || *study || *calibrate || *optimize || *twin || *replay || *serve)
    o.scenes = {scene};
  if (ranks) {
    if (!*study && !*calibrate && !*optimize)
      throw beltlife::BadInput(
          {beltlife::Problem{"mpirun", 0, "", "this command runs in one process", "study, calibrate, optimize"}});
    o.ranks = ranks;
    o.threads = ranks->threads(o.threads);
    o.quiet = o.quiet || !ranks->leads();
  }
  if (!shorthand.scheme.empty()) o.settings.push_back("solver.scheme=" + shorthand.scheme);
  if (!shorthand.step.empty()) o.settings.push_back("solver.step_s=" + shorthand.step);
  if (!shorthand.elements.empty()) o.settings.push_back("belt.elements=" + shorthand.elements);
  if (*check) return beltlife::run_check(o);
  if (*modes) return beltlife::run_modes(o);
  if (*simulate) return beltlife::run_simulate(o);
  if (*life) return beltlife::run_life(o);
  if (*report) {
    std::vector<beltlife::StudyPage> pages(beltlife::study_pages().begin(), beltlife::study_pages().end());
    pages.push_back(beltlife::calibrate_page());
    pages.push_back(beltlife::optimize_page());
    return beltlife::run_report(o, pages);
  }
  if (*export_) return beltlife::run_export(o);
  if (*optimize) return beltlife::run_optimize(o);
  if (*twin) return beltlife::run_twin(o);
  if (*calibrate) return beltlife::run_calibrate(o);
  if (*study) return beltlife::run_study(o);
  if (*replay) return beltlife::run_replay(o);
  if (*serve) return beltlife::run_serve(o);
  std::cerr << app.help();
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  std::unique_ptr<beltlife::Ranks> ranks;
  const auto failed = [&](const std::string& words, int code) {
    if (ranks && !ranks->leads())
      ranks->decline(words);
    else
      std::fprintf(stderr, "%s\n", words.c_str());
    return code;
  };
  try {
    ranks = beltlife::Ranks::join();
    const int code = run(argc, argv, ranks.get());
    if (std::fflush(stdout) == 0 && std::cout.flush()) return code;
    return failed(std::string("beltlife: the answer cannot be written to standard output: ") + std::strerror(errno), 3);
  } catch (const beltlife::BadInput& bad) {
    return failed(bad.what(), 2);
  } catch (const std::exception& bug) {
    return failed(
        std::string("beltlife: a bug: ") + bug.what() + "\nplease report it with the command and the scene file", 4);
  }
}
