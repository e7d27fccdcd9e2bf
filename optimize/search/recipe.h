// Owns the searches made of several NLopt runs: screening, CRS2, COBYLA from several designs.
#pragma once

#include "optimize/search/search.h"
#include "optimize/search/search_ledger.h"

namespace beltlife {

/// Each spends what the ledger has left, unless it converges before, and says why it ended.
std::string crs2_cobyla(SearchLedger& ledger, const SearchOptions& options);
std::string cobyla_multistart(SearchLedger& ledger, const SearchOptions& options);

/// One of NLopt's algorithms alone, from the best trial so far.
std::string nlopt_alone(SearchLedger& ledger, const SearchOptions& options);

/// Low-discrepancy points of feasible geometry.
std::string random_search(SearchLedger& ledger, const SearchOptions& options);

}  // namespace beltlife
