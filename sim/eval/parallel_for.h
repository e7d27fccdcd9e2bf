// Owns parallelism: one loop over independent pieces of work, on OpenMP threads.
#pragma once

#include <functional>

namespace beltlife {

/// Calls body(0) .. body(count - 1), each once, on `threads` threads (0: as many as the machine has), the next free
/// thread taking the next index. An exception from a body is rethrown once all are done (the one of the lowest index).
/// Results must not depend on which thread ran what.
void parallel_for(int count, int threads, const std::function<void(int)>& body);

}  // namespace beltlife
