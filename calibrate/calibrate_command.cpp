// The commands calibrate and twin: see commands.h.
#include "calibrate/calibration.h"
#include "calibrate/commands.h"
#include "calibrate/twin.h"
#include "results/course/run_driver.h"
#include "results/course/shared_options.h"

namespace beltlife {

void add_calibrate_command(CommandLine& line) {
  auto o = std::make_shared<DriverOptions>();
  Command command = line.command("calibrate", "fit parameters to measured spectra or numbers, with intervals");
  driver_flags(command, *o, "calibration file (TOML)", false);
  command.prints("--fields", reference_of<CalibrationSpec>, "print the reference of the file's fields as Markdown")
      .prints("--answer", reference_of_answer<CalibrationAnswer>,
              "print the reference of the answer's parts as Markdown")
      .footer(
          "Examples:\n"
          "  beltlife calibrate calibrate/examples/small.toml --set profile.hold_s=1 --set profile.evaluate_s=0.48\n"
          "  beltlife calibrate calibrate/examples/fine.toml --set profile.hold_s=1.5 --out fine.h5 && beltlife report "
          "fine.h5\n"
          "A run that is stopped goes on with the same command. Fields of the file: --fields, or calibrate/README.md.")
      .spreads_over_processes()
      .runs(
          o, +[](const DriverOptions& options) { return run_driver<Calibration>(options, "calibrate"); });
}

void add_twin_command(CommandLine& line) {
  auto o = std::make_shared<TwinOptions>();
  Command command =
      line.command("twin", "make records out of the model, with hidden parameters and noise, to try a calibration on");
  common_flags(command, *o);
  threads_flag(command, o->threads, "ranges");
  command.whole("--seed", o->seed, {}, "seed of the noise, instead of the file's")
      .text("--out", o->out, "PREFIX", "beginning of the files' names, PREFIX_RANGE.csv; by default the twin file's")
      .input("twin", o->file, "twin file (TOML)")
      .prints("--fields", reference_of<TwinSpec>, "print the reference of the file's fields as Markdown")
      .footer("Example:\n  beltlife twin calibrate/examples/small_twin.toml --out build/small")
      .runs(o, run_twin);
}

}  // namespace beltlife
