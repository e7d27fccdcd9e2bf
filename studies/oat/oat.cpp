// Comparison of replicates: see oat.h.
#include "studies/oat/oat.h"

#include <algorithm>
#include <cmath>

#include "studies/noise/noise.h"

namespace beltlife {

Effect compare(const std::vector<double>& before, const std::vector<double>& after, double visible,
               double standard_errors) {
  Effect e;
  const Spread a = spread_of(before), b = spread_of(after);
  e.before = a.mean;
  e.after = b.mean;
  const double scale = a.mean != 0 ? std::abs(a.mean) : std::abs(b.mean);
  if (scale == 0) return e;
  e.change = (b.mean - a.mean) / scale;
  e.standard_error = std::sqrt(a.standard_deviation * a.standard_deviation / static_cast<double>(before.size()) +
                               b.standard_deviation * b.standard_deviation / static_cast<double>(after.size())) /
                     scale;
  e.beyond_noise = std::abs(e.change) > standard_errors * e.standard_error;
  e.visible = e.beyond_noise && std::abs(e.change) >= visible;
  e.responses_before = responses_of(before).size();
  e.responses_after = responses_of(after).size();
  return e;
}

std::string verdict_of(const std::vector<Effect>& effects) {
  const Effect* largest = nullptr;
  for (const Effect& e : effects)
    if (e.beyond_noise && (!largest || std::abs(e.change) > std::abs(largest->change))) largest = &e;
  if (!largest) return "none";
  return std::string(largest->visible ? "" : "slight ") + (largest->change < 0 ? "decrease" : "increase");
}

}  // namespace beltlife
