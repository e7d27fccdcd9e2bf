// Owns the drive in motion under the linearly implicit scheme that the verification tests of that scheme read.
#pragma once

#include "drives.h"
#include "sim/lanes/lane_simulator.h"

namespace beltlife::drives {

/// As Drive, in lanes. `prepare` may change the model before it starts.
struct ImplicitDrive {
  template <class Prepare>
  ImplicitDrive(const SceneSpec& scene, SpeedProfile given, double step, LaneUse use, Prepare prepare)
      : model(compile(scene)),
        profile(std::move(given)),
        simulator((prepare(model), std::vector<LaneDrive>{{&model, &profile}}), use, step) {}
  ImplicitDrive(const SceneSpec& scene, SpeedProfile given, double step, LaneUse use = LaneUse::arcs)
      : ImplicitDrive(scene, std::move(given), step, use, [](Model&) {}) {}
  ImplicitDrive(const ImplicitDrive&) = delete;
  ImplicitDrive& operator=(const ImplicitDrive&) = delete;

  /// Advances to a time and hands `each` what is seen after every `stride` steps.
  template <class Each>
  void run_to(double seconds, int stride, Each each) {
    while (simulator.time() < seconds - 0.5 * simulator.step()) {
      for (int i = 0; i < stride; ++i) simulator.advance();
      each(simulator.observe(0));
    }
  }

  Model model;
  SpeedProfile profile;
  LaneSimulator simulator;
};

}  // namespace beltlife::drives
