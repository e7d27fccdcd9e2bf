// One run of an NLopt algorithm: see nlopt_search.h.
#include "optimize/search/nlopt_search.h"

#include <nlopt.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <stdexcept>

namespace beltlife {
namespace {

nlopt_algorithm algorithm_of(SearchAlgorithm method) {
  switch (method) {
    case SearchAlgorithm::crs2:
      return NLOPT_GN_CRS2_LM;
    case SearchAlgorithm::isres:
      return NLOPT_GN_ISRES;
    case SearchAlgorithm::esch:
      return NLOPT_GN_ESCH;
    case SearchAlgorithm::direct_l:
      return NLOPT_GN_DIRECT_L;
    case SearchAlgorithm::bobyqa:
      return NLOPT_LN_BOBYQA;
    case SearchAlgorithm::neldermead:
      return NLOPT_LN_NELDERMEAD;
    case SearchAlgorithm::sbplx:
      return NLOPT_LN_SBPLX;
    case SearchAlgorithm::cobyla:
      return NLOPT_LN_COBYLA;
    default:
      throw std::logic_error("run_nlopt: not an algorithm of NLopt");
  }
}

bool stops_on_steps(SearchAlgorithm method) {
  return method != SearchAlgorithm::isres && method != SearchAlgorithm::esch && method != SearchAlgorithm::direct_l;
}

// NLopt is C: no exception may cross it. After the stop it may still call, and is then told the last thing again.
struct Run {
  const NloptTask& task;
  nlopt_opt optimizer;
  Design last;
  Assessed answer;
  int calls = 0;
  bool stopped = false;
  std::exception_ptr thrown;

  void look_at(unsigned n, const double* x) {
    if (stopped) return;
    // Both callbacks come here for every point; NLopt's steps may leave the box by rounding.
    Design at(x, x + n);
    for (unsigned i = 0; i < n; ++i) at[i] = std::clamp(at[i], task.lower[i], task.upper[i]);
    if (++calls > 2 * task.max_calls) return stop();
    if (at == last) return;
    try {
      std::optional<Assessed> found = task.assess(at);
      if (!found) return stop();
      answer = std::move(*found);
      last = std::move(at);
    } catch (...) {
      thrown = std::current_exception();
      stop();
    }
  }
  void stop() {
    stopped = true;
    answer.constraints.resize(task.constraints, 0.0);
    nlopt_force_stop(optimizer);
  }
};

double objective_of(unsigned n, const double* x, double*, void* data) {
  Run& run = *static_cast<Run*>(data);
  run.look_at(n, x);
  return run.answer.objective;
}

void violations_of(unsigned m, double* result, unsigned n, const double* x, double*, void* data) {
  Run& run = *static_cast<Run*>(data);
  run.look_at(n, x);
  for (unsigned i = 0; i < m; ++i) result[i] = -run.answer.constraints[i];
}

}  // namespace

NloptTask::NloptTask(SearchAlgorithm which, const Design& from)
    : method(which), start(from), lower(from.size(), 0.0), upper(from.size(), 1.0) {}

std::string run_nlopt(const NloptTask& task) {
  const auto n = static_cast<unsigned>(task.start.size());
  // BOBYQA's quadratic needs two variables.
  const bool alone = task.method == SearchAlgorithm::bobyqa && n < 2;
  const SearchAlgorithm method = alone ? SearchAlgorithm::neldermead : task.method;
  const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> optimizer(nlopt_create(algorithm_of(method), n),
                                                                    nlopt_destroy);
  if (!optimizer) throw std::bad_alloc();
  Run run{task, optimizer.get(), {}, {}, 0, false, nullptr};
  run.answer.constraints.assign(task.constraints, 0.0);
  nlopt_set_lower_bounds(run.optimizer, task.lower.data());
  nlopt_set_upper_bounds(run.optimizer, task.upper.data());
  nlopt_set_min_objective(run.optimizer, objective_of, &run);
  if (task.constraints > 0 && (method == SearchAlgorithm::cobyla || method == SearchAlgorithm::isres))
    nlopt_add_inequality_mconstraint(run.optimizer, static_cast<unsigned>(task.constraints), violations_of, &run,
                                     nullptr);
  if (stops_on_steps(method)) nlopt_set_xtol_abs1(run.optimizer, task.xtol);
  nlopt_set_initial_step1(run.optimizer, task.step);
  nlopt_set_maxeval(run.optimizer, task.max_calls);
  nlopt_srand(static_cast<unsigned long>(task.seed));
  Design x = task.start;
  for (unsigned i = 0; i < n; ++i) x[i] = std::clamp(x[i], task.lower[i], task.upper[i]);
  double least = 0;
  const nlopt_result result = nlopt_optimize(run.optimizer, x.data(), &least);
  if (run.thrown) std::rethrow_exception(run.thrown);
  if (result == NLOPT_MAXEVAL_REACHED || run.calls > 2 * task.max_calls) return "too many points without a simulation";
  if (run.stopped) return "budget spent";
  return result == NLOPT_ROUNDOFF_LIMITED ? "converged as far as rounding allows"
         : result < 0                     ? "the algorithm gave up"
                                          : "converged";
}

}  // namespace beltlife
