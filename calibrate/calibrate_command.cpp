// The command calibrate: see commands.h.
#include "calibrate/calibration.h"
#include "calibrate/commands.h"
#include "results/course/run_driver.h"

namespace beltlife {

int run_calibrate(const CommandOptions& o) { return run_driver<Calibration>(o, "calibrate"); }

std::string calibrate_fields() { return reference_of<CalibrationSpec>(); }

}  // namespace beltlife
