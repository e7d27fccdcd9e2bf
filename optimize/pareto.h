// Owns the trade between two objectives: the searches along the front, and what of all that was tried is on it.
#pragma once

#include "optimize/design_search.h"

namespace beltlife {

/// Of the feasible designs those that no other one beats in one objective without losing in the other; best by the
/// first objective first. Indices into `tried`.
std::vector<std::size_t> front_of(const OptimizationSpec& spec, const std::vector<Tried>& tried);

/// One search for each objective alone, then one for the first objective at every level of the second (epsilon
/// constraints), each from the best design known to hold the level. The budget is shared equally. Says why they ended.
std::string search_front(DesignSearch& search, const OptimizationSpec& spec, const Candidate& start,
                         std::size_t budget);

}  // namespace beltlife
