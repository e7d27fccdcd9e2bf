// The command simulate of a scene with an event: its run, and the extremes of every part with their times.
#include <fmt/format.h>

#include "results/commands/stretch_run.h"
#include "results/course/scene_runs.h"
#include "results/text/event_text.h"
#include "results/text/print.h"

namespace beltlife {

int run_event(const LoadedScene& l, const SimulateOptions& o) {
  const RunPlan plan = plan_event(l.file.scene);
  const StretchRun run = run_stretch(l, plan, o);
  const EventSummary summary = summarise_event(l.model, run.record, run.window);
  write_file(l, {run.record}, nullptr, o, {nullptr, &run.window});
  if (o.json) {
    nlohmann::json j = json_of(run, plan);
    j["event"] = json_of(summary);
    fmt::print("{}\n", json_text(j));
  } else {
    fmt::print("{}{}", text_of(summary), closing_text(run, l, o));
  }
  return run.failed ? 3 : 0;
}

}  // namespace beltlife
