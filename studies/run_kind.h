// Owns a kind of study as a driver: its settings are the table [study] of its file.
#pragma once

#include "results/course/run_driver.h"

namespace beltlife {

/// `Kind` has a Settings with visit() and check(log), and is otherwise as run_driver() wants it, but that it is made
/// from its settings.
template <class Kind>
struct StudyDriver : Kind {
  using Spec = StudySpec<typename Kind::Settings>;
  static void prepare(Spec& spec, const DriverOptions& o, ReadLog& log) {
    if constexpr (requires { spec.study.seed; })
      if (o.seed) spec.study.seed = static_cast<std::int64_t>(*o.seed);
    spec.study.check(log);
  }
  StudyDriver(const LoadedProblem& problem, const Spec& spec, ReadLog& log) : Kind(problem, spec.study, log) {}
};

}  // namespace beltlife
