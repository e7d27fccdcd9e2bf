// Owns the search on surrogates: Gaussian processes of objective and constraints in a trust region.
#pragma once

#include "optimize/search/search.h"
#include "optimize/search/search_ledger.h"

namespace beltlife {

/// Every round fits one process to the objective, one to each simulated constraint and, once trials failed, one to
/// failure, through the trials nearest to the best design of the region; then asks a batch: minima of lower confidence
/// bounds of several boldnesses under the constraints' bounds (geometry exact), each after the ones before are
/// believed. The region grows with success, shrinks with failure and starts anew elsewhere once it is small (after
/// SCBO: Eriksson & Poloczek 2021); the last quarter of the budget refines the best of all regions. Spends what the
/// ledger has left and says why it ended.
std::string kriging_search(SearchLedger& ledger, const SearchOptions& options);

}  // namespace beltlife
