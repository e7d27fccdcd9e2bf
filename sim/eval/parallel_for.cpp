// Parallel loop: see parallel_for.h.
#include "sim/eval/parallel_for.h"

#include <omp.h>

#include <algorithm>
#include <exception>
#include <vector>

namespace beltlife {

void parallel_for(int count, int threads, const std::function<void(int)>& body) {
  std::vector<std::exception_ptr> errors(static_cast<std::size_t>(count));
  const int workers = std::clamp(threads > 0 ? threads : omp_get_num_procs(), 1, std::max(count, 1));
#pragma omp parallel for schedule(dynamic, 1) num_threads(workers)
  for (int i = 0; i < count; ++i) {
    try {
      body(i);
    } catch (...) {
      errors[static_cast<std::size_t>(i)] = std::current_exception();
    }
  }
  for (const auto& error : errors)
    if (error) std::rethrow_exception(error);
}

}  // namespace beltlife
