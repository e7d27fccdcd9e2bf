// Owns the decision whether a coarse model may search: does it rank layouts as the fine one does?
#pragma once

#include "optimize/design_search.h"

namespace beltlife {

/// Spearman's rank correlation; ties have the mean of their ranks. 0 of fewer than two values, or if all of one list
/// are equal.
double rank_correlation(const std::vector<double>& a, const std::vector<double>& b);

/// From this rank correlation on, the coarse model searches.
inline constexpr double enough_correlation = 0.8;

struct FidelityCheck {
  double correlation = 0;
  std::size_t compared = 0;  ///< designs that both models ran to the end
  std::size_t asked = 0;     ///< designs of feasible geometry, the start among them if it is one
  bool trusted = false;      ///< at least 5 compared, and correlation enough
  std::vector<Tried> fine;   ///< what the fine model said
};

/// Simulates designs spread over the bounds, in the scene's own choices, coarse and fine.
FidelityCheck check_fidelity(DesignRuns& runs);

}  // namespace beltlife
