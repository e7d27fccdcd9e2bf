// Owns the smallest program that embeds the simulator: a scene file and a range in, tensions and order 3 out.
#include <cstdio>

#include "sim/eval/run_ranges.h"
#include "sim/eval/summary.h"
#include "sim/scene/scene_io.h"

int main(int arguments, char** argument) try {
  if (arguments < 3) {
    std::fprintf(stderr, "usage: embed SCENE.toml RANGE [PATH=VALUE ...]\n");
    return 1;
  }
  // Reading checks every field. Settings are those of --set: any field of the scene by its path.
  const beltlife::SceneFile file = beltlife::read_scene(argument[1], {argument + 3, argument + arguments});
  // From the scene to flat constant numbers; layouts that cannot be built are refused here. The model may be shared
  // by any number of runs and threads.
  const beltlife::Model model = beltlife::compile(file.scene, argument[1]);
  // What to run: from rest to the end of the range's hold, whose last evaluate_s are evaluated; no measured speed.
  const auto plans = beltlife::plans_of(file.scene, {argument[2]}, nullptr);
  // Runs them on all processors (0). A drive that flies apart is no exception: the record says where and why.
  const auto outcomes = beltlife::run_plans(model, plans, 0);
  const beltlife::RunRecord& run = outcomes.front().record;
  if (!run.status.ok()) {
    std::fprintf(stderr, "failed at %g s, %s: %s\n", run.status.time_s, run.status.where.c_str(),
                 run.status.cause.c_str());
    return 3;
  }
  // Traces, contact forces and energy are in the record; the summary reduces its window to the numbers of `simulate`.
  const beltlife::RangeSummary range = beltlife::summarise(model, run, run.windows.front());
  for (const beltlife::SpanSummary& span : range.spans)
    std::printf("%s: tension %.17g N, %.17g to %.17g\n", span.name.c_str(), span.tension_n_mean, span.tension_n_min,
                span.tension_n_max);
  if (range.output)  // none in a drive without a loaded shaft
    for (const beltlife::OrderLine& line : range.output->orders)
      if (line.order == 3) std::printf("order 3: speed %.17g r/min\n", line.speed_rpm);
  return 0;
} catch (const beltlife::BadInput& bad) {  // every problem, one a line: file:line: key: what (allowed: ...)
  std::fprintf(stderr, "%s\n", bad.what());
  return 2;
}
