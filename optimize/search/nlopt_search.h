// Owns the way into NLopt: one run of one of its algorithms, safe against exceptions, endless runs and hidden seeds.
#pragma once

#include <optional>

#include "optimize/search/search.h"

namespace beltlife {

/// What a run is told about a point: all finite; constraints are satisfied where >= 0.
struct Assessed {
  double objective = 0;
  std::vector<double> constraints;
};

struct NloptTask {
  /// On the unit cube, from `start`; the members say the rest.
  NloptTask(SearchAlgorithm method, const Design& start);

  SearchAlgorithm method;  ///< one that NLopt has: crs2, cobyla, isres, esch, direct_l, bobyqa, neldermead, sbplx
  Design start, lower, upper;
  double step = 0.1;   ///< first step of a local method
  double xtol = 1e-4;  ///< step at which a local method or CRS2 has converged
  int max_calls = 0;   ///< the watchdog: free points cost nothing, so no budget would end a run among them
  std::int64_t seed = 1;
  std::size_t constraints = 0;  ///< given to cobyla and isres; the others know none and ignore them
  /// Called once a point. Nothing: the run ends.
  std::function<std::optional<Assessed>(const Design&)> assess;
};

/// Runs it and says in words why it ended. An exception of `assess` ends the run and comes out here.
std::string run_nlopt(const NloptTask& task);

}  // namespace beltlife
