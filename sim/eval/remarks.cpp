// Remarks about a drive: see remarks.h.
#include "sim/eval/remarks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace beltlife {

std::string coarse_mesh(const Model& m) {
  if (m.pulleys == 0) return "";
  const auto smallest = std::min_element(m.pulley_radius.begin(), m.pulley_radius.end());
  if (m.belt.element_length <= *smallest / 5) return "";
  return fmt::format(
      "elements of {:.1f} mm are coarse for pulley {}; contact forces and life need at least {:.0f} elements",
      1e3 * m.belt.element_length, m.body_name[static_cast<std::size_t>(smallest - m.pulley_radius.begin())],
      std::ceil(5 * m.belt.unstretched_length / *smallest));
}

}  // namespace beltlife
