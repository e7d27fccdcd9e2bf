// The pages of the kinds of study: see pages.h.
#include "studies/pages.h"

#include "results/pages/study/study_parts.h"
#include "studies/convergence/convergence_page.h"
#include "studies/morris/morris_page.h"
#include "studies/noise/noise_page.h"
#include "studies/oat/oat_page.h"
#include "studies/sobol/sobol_page.h"
#include "studies/stability/stability_page.h"
#include "studies/surrogate/surrogate_page.h"
#include "studies/uncertainty/uncertainty_page.h"

namespace beltlife {
namespace {

constexpr StudyPage pages[] = {
    {"study noise", "Noise", "how far quantities scatter without anything of importance being changed",
     typed_part<NoiseAnswer, noise_part>, true, ""},
    {"study convergence", "Convergence", "error against run time, by scheme, step and mesh",
     typed_part<ConvergenceAnswer, convergence_part>, false,
     "A setting that failed has no errors; it stays in the table of settings."},
    {"study stability", "Stability", "predicted and observed stable steps, and whether extreme cases run",
     typed_part<StabilityAnswer, stability_part>, false,
     "Bisection needs points on both sides of the longest stable step: many diverge by design."},
    {"study oat", "One change at a time", "what single changes do, beside what was said of them",
     typed_part<OatAnswer, oat_part>, false, "A side that failed at some crank phases is judged by the others."},
    {"study morris", "Elementary effects", "which parameters matter at all", typed_part<MorrisAnswer, morris_part>,
     true, "An effect needs both its points; those without are left out of the means."},
    {"study sobol", "Sobol indices", "which share of the variance is whose", typed_part<SobolAnswer, sobol_part>, true,
     "A base row with a failed point is left out whole. If failures favour some values, the indices are those of what "
     "did not fail."},
    {"study surrogate", "Surrogate", "which share of the variance is whose, by a function fitted to the points",
     typed_part<SurrogateAnswer, surrogate_part>, true, "The surrogate is fitted to none of them."},
    {"study uncertainty", "Uncertainty", "how far quantities scatter with the scatter of the parameters",
     typed_part<UncertaintyAnswer, uncertainty_part>, true, "They are missing from every percentile and share."},
};

}  // namespace

std::span<const StudyPage> study_pages() { return pages; }

}  // namespace beltlife
