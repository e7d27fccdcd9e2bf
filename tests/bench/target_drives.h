// Owns what the measurements of the targets share: the drives that are run, and the list of targets.
#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/eval/run_ranges.h"
#include "sim/run.h"
#include "sim/scene/scene_io.h"
#include "tests/bench/measure.h"

namespace beltlife::bench {

inline const std::string range = "B100";

struct Settings {
  bool quick = false;
  std::string reference;  ///< file; empty: computed
};

/// The baseline, shortened: `brief` for costs alone, the other for results too.
inline SceneSpec baseline(const Settings& settings, Scheme scheme, std::optional<double> step_s, bool brief = false) {
  SceneSpec scene = read_scene(BELTLIFE_SCENES "/baseline.toml").scene;
  scene.solver.scheme = scheme;
  scene.solver.step_s = step_s;
  ProfileSpec& p = scene.profile;
  p.hold_s = 1.2;
  p.settled_within.reset();
  if (!settings.quick && !brief) return scene;
  p.settle_s = 0.05;
  p.ramp_s = 0.15;
  p.hold_s = 0.3;
  p.evaluate_s = 0.2;
  return scene;
}

/// A drive and what came of its last run.
struct Drive {
  explicit Drive(const SceneSpec& scene) : model(compile(scene)), plan(plans_of(scene, {range}, nullptr).front()) {}

  void run() { take(beltlife::run(model, plan)); }
  void take(RunOutcome&& outcome) {
    record = std::move(outcome.record);
    if (!record.status.ok()) throw std::runtime_error("a run failed: " + record.status.cause);
  }

  Model model;
  RunPlan plan;
  RunRecord record;
};

inline std::vector<std::function<void()>> runs_of(std::vector<Drive>& drives) {
  std::vector<std::function<void()>> works;
  for (Drive& d : drives) works.emplace_back([&d] { d.run(); });
  return works;
}

/// Targets with what was measured for them; a number that was not measured is null.
class Targets {
 public:
  void add(const std::string& name, bool at_least, double target, std::optional<double> stretch, double measured) {
    const auto met = [&](double bound) {
      return std::isnan(measured) ? Json() : Json(at_least ? measured >= bound : measured <= bound);
    };
    list.push_back({{"name", name}, {"bound", at_least ? "at least" : "at most"}, {"target", target}});
    list.back()["measured"] = measured;
    list.back()["met"] = met(target);
    list.back()["stretch"] = stretch ? Json(*stretch) : Json();
    list.back()["stretch_met"] = stretch ? met(*stretch) : Json();
  }
  Json list = Json::array();
};

/// Real-time factors and errors of the linearly implicit scheme by step, and of symplectic Euler.
Json accuracy(const Settings& settings, Targets& targets);

}  // namespace beltlife::bench
