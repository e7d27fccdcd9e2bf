// The kinds of study: see commands.h.
#include <algorithm>

#include "studies/commands.h"
#include "studies/convergence/convergence_study.h"
#include "studies/morris/morris_study.h"
#include "studies/noise/noise_study.h"
#include "studies/oat/oat_study.h"
#include "studies/run_kind.h"
#include "studies/sobol/sobol_study.h"
#include "studies/stability/stability_study.h"
#include "studies/surrogate/surrogate_study.h"
#include "studies/uncertainty/uncertainty_study.h"

namespace beltlife {
namespace {

template <class Kind>
StudyKind kind(const char* name, const char* about) {
  constexpr bool seeded = requires(typename Kind::Settings s) { s.seed; };
  return {name, about, run_kind<Kind>, seeded, reference_of<StudySpec<typename Kind::Settings>>};
}

}  // namespace

const std::vector<StudyKind>& study_kinds() {
  static const std::vector<StudyKind> kinds{
      kind<OatStudy>("oat", "one change at a time: what moves, what does not, and what somebody said of it"),
      kind<NoiseStudy>("noise", "how far each quantity scatters by itself, and responses that coexist"),
      kind<ConvergenceStudy>("convergence", "error against run time by scheme, step and mesh; the cheapest setting"),
      kind<StabilityStudy>("stability", "predicted and observed stable steps over stiff cases, and extreme cases"),
      kind<MorrisStudy>("morris", "which parameters matter at all, from few points, against the noise"),
      kind<SobolStudy>("sobol", "which share of the variance comes from which parameter, with intervals"),
      kind<UncertaintyStudy>("uncertainty",
                             "how quantities scatter when parameters do; B10 life; odds of missing a target"),
      kind<SurrogateStudy>("surrogate", "a fitted function in place of the simulator, its Q2 and its indices"),
  };
  return kinds;
}

int run_study(const CommandOptions& o) {
  const auto& kinds = study_kinds();
  return std::find_if(kinds.begin(), kinds.end(), [&](const StudyKind& k) { return k.name == o.kind; })->run(o);
}

}  // namespace beltlife
