// Owns how shares of a variance stand on a page, sampled (kind sobol) or of a surrogate.
#pragma once

#include <string>
#include <vector>

#include "results/answer/estimate.h"
#include "results/pages/study/study_parts.h"

namespace beltlife {

struct ParameterShares {
  std::string name;
  Estimate first, total;  ///< a share without an interval has a value alone
};

struct SharedQuantity {
  std::string name;
  std::vector<ParameterShares> shares;  ///< of those that have one, largest total first
  Estimate sum;                         ///< of the first shares, where it is stated
  std::string about;                    ///< HTML: what is said before chart and table
};

void sort_by_total(std::vector<ParameterShares>& shares);

/// Which parameter has the largest share of what, for the first quantities.
std::string shares_in_words(const std::vector<SharedQuantity>& quantities);

/// Chart and table of every quantity.
std::string shares_html(const std::vector<SharedQuantity>& quantities);

inline constexpr const char* about_shares =
    "Alone: the share of the variance that goes with this parameter whatever the others are. With interactions: also "
    "what it does together with others; where the two differ, parameters interact.";

}  // namespace beltlife
