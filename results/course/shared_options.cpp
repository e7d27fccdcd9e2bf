// The flags that commands share: see shared_options.h.
#include "results/course/shared_options.h"

namespace beltlife {

void common_flags(Command& c, CommonOptions& o) {
  c.texts("--set", o.settings, "PATH=VALUE",
          "change a scene field by path, e.g. --set tensioner.friction_torque_n_m=4 (repeatable)")
      .stands_for("--scheme", "solver.scheme", o.settings,
                  "time integrator: linearly_implicit, symplectic_euler or thesis")
      .stands_for("--step", "solver.step_s", o.settings, "time step in s")
      .stands_for("--elements", "belt.elements", o.settings, "belt elements")
      .flag("--json", o.json, "print one JSON object on standard output")
      .flag("--quiet", o.quiet, "no progress on standard error");
}

void threads_flag(Command& c, int& threads, const std::string& over) {
  c.whole("--threads", threads, {0, 1024}, "threads over " + over + ", 0: all");
}

void frames_flag(Command& c, int& frames) {
  c.whole("--frames", frames, {0, 1000}, "frames of the moving belt that --out keeps of every range; 0: none");
}

void range_flags(Command& c, RangeOptions& o) {
  common_flags(c, o);
  c.texts("--range", o.ranges, "NAME", "only this operating range (repeatable)");
  threads_flag(c, o.threads, "ranges");
  c.flag("--force", o.force, "run with a step beyond the scheme's predicted limit")
      .text("--out", o.out, "FILE.h5", "write an HDF5 result file; of several scenes FILE_SCENE.h5 each");
  frames_flag(c, o.frames);
}

void driver_flags(Command& c, DriverOptions& o, const std::string& file, bool seeded) {
  common_flags(c, o);
  threads_flag(c, o.threads, "points");
  if (seeded) c.whole("--seed", o.seed, {}, "seed of whatever is drawn at random, instead of the file's");
  c.text("--out", o.out, "FILE.h5", "HDF5 result file; its log stands beside it; by default named after the study file")
      .input("study", o.file, file);
}

}  // namespace beltlife
