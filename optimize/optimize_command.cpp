// The command optimize: see commands.h.
#include "optimize/commands.h"
#include "optimize/layout_search.h"
#include "results/course/run_driver.h"

namespace beltlife {

int run_optimize(const CommandOptions& o) { return run_driver<LayoutSearch>(o, "optimize"); }

std::string optimize_fields() { return reference_of<OptimizationSpec>(); }

}  // namespace beltlife
