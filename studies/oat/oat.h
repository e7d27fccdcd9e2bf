// Owns the comparison of two sets of replicates of one quantity.
#pragma once

#include <string>
#include <vector>

namespace beltlife {

/// What a change did to a quantity.
struct Effect {
  double before = 0, after = 0;  ///< means over the replicates
  double change = 0;             ///< relative to `before`; of a quantity that is 0 before: of `after`
  double standard_error = 0;     ///< of the change, from the scatter of the replicates on both sides
  bool beyond_noise = false;
  bool visible = false;                                   ///< beyond noise, and large enough for a reader of plots
  std::size_t responses_before = 1, responses_after = 1;  ///< steady responses that coexist among the replicates
};

/// `visible` is the relative change that can be seen, `standard_errors` how many of them are noise. A pair of single
/// values has no scatter: any difference is beyond noise.
Effect compare(const std::vector<double>& before, const std::vector<double>& after, double visible,
               double standard_errors);

/// "none", "decrease" or "increase" by the largest visible change; "slight ..." where changes are beyond noise but none
/// can be seen.
std::string verdict_of(const std::vector<Effect>& effects);

}  // namespace beltlife
