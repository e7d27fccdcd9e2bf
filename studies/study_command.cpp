// The kinds of study: see commands.h.
#include "results/course/shared_options.h"
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

template <class Kind, const char* name>
StudyKind kind(const char* about) {
  constexpr bool seeded = requires(typename Kind::Settings s) { s.seed; };
  const auto run =
      +[](const DriverOptions& o) { return run_driver<StudyDriver<Kind>>(o, std::string("study ") + name); };
  return {name,
          about,
          run,
          seeded,
          reference_of<StudySpec<typename Kind::Settings>>,
          reference_of_answer<typename Kind::Result>};
}

// Names as constants, so that a kind's name is part of the function that runs it.
constexpr char oat[] = "oat", noise[] = "noise", convergence[] = "convergence", stability[] = "stability",
               morris[] = "morris", sobol[] = "sobol", uncertainty[] = "uncertainty", surrogate[] = "surrogate";

}  // namespace

const std::vector<StudyKind>& study_kinds() {
  static const std::vector<StudyKind> kinds{
      kind<OatStudy, oat>("one change at a time: what moves, what does not, and what somebody said of it"),
      kind<NoiseStudy, noise>("how far each quantity scatters by itself, and responses that coexist"),
      kind<ConvergenceStudy, convergence>("error against run time by scheme, step and mesh; the cheapest setting"),
      kind<StabilityStudy, stability>("predicted and observed stable steps over stiff cases, and extreme cases"),
      kind<MorrisStudy, morris>("which parameters matter at all, from few points, against the noise"),
      kind<SobolStudy, sobol>("which share of the variance comes from which parameter, with intervals"),
      kind<UncertaintyStudy, uncertainty>(
          "how quantities scatter when parameters do; B10 life; odds of missing a target"),
      kind<SurrogateStudy, surrogate>("a fitted function in place of the simulator, its Q2 and its indices"),
  };
  return kinds;
}

void add_study_command(CommandLine& line) {
  Command study = line.command("study", "what moves a quantity, and how far it can be trusted");
  for (const StudyKind& kind : study_kinds()) {
    auto o = std::make_shared<DriverOptions>();
    Command command = study.command(kind.name, kind.about);
    driver_flags(command, *o, "study file (TOML)", kind.seeded);
    command.prints("--fields", kind.fields, "print the reference of the file's fields as Markdown")
        .prints("--answer", kind.answer, "print the reference of the answer's parts as Markdown")
        .footer("Example:\n  beltlife study " + kind.name + " studies/examples/" + kind.name +
                ".toml\nA run that is stopped goes on with the same command. Fields of the file: beltlife study " +
                kind.name + " --fields, or studies/README.md.")
        .spreads_over_processes()
        .runs(o, kind.run);
  }
  study.footer(
      "Examples:\n"
      "  beltlife study noise studies/examples/noise.toml\n"
      "  beltlife study oat studies/examples/oat.toml --out oat.h5 && beltlife report oat.h5\n"
      "  beltlife study sobol --fields");
}

}  // namespace beltlife
