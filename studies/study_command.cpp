// The kinds of study: see commands.h.
#include <algorithm>

#include "studies/commands.h"
#include "studies/convergence_study.h"
#include "studies/noise_study.h"
#include "studies/run_kind.h"
#include "studies/stability_study.h"

namespace beltlife {
namespace {

template <class Kind>
StudyKind kind(const char* name, const char* about) {
  return {name, about, run_kind<Kind>, reference_of<StudySpec<typename Kind::Settings>>};
}

}  // namespace

const std::vector<StudyKind>& study_kinds() {
  static const std::vector<StudyKind> kinds{
      kind<NoiseStudy>("noise", "how far each quantity scatters by itself, and responses that coexist"),
      kind<ConvergenceStudy>("convergence", "error against run time by scheme, step and mesh; the cheapest setting"),
      kind<StabilityStudy>("stability", "predicted and observed stable steps over stiff cases, and extreme cases"),
  };
  return kinds;
}

int run_study(const CommandOptions& o) {
  const auto& kinds = study_kinds();
  return std::find_if(kinds.begin(), kinds.end(), [&](const StudyKind& k) { return k.name == o.kind; })->run(o);
}

}  // namespace beltlife
