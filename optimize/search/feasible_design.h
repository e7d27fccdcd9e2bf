// Owns the question whether any design has a layout that keeps its limits.
#pragma once

#include <cstdint>
#include <optional>

#include "optimize/search/search_problem.h"

namespace beltlife {

/// Designs of feasible geometry, at most `count`, low-discrepancy, found without a simulation; fewer, or none, where a
/// few thousand trials and repairs find no more.
std::vector<Design> feasible_designs(const SearchProblem& problem, std::size_t count, std::int64_t seed);

/// The design of the least broken limits that the same trials and repairs find.
Design least_violating(const SearchProblem& problem, std::int64_t seed);

}  // namespace beltlife
