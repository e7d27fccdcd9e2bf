// Owns the batch evaluation of drives: points x ranges in packs of eight lanes, on threads, with a memo.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "sim/eval/quantities.h"
#include "sim/lanes/lane_belt.h"
#include "sim/life/life.h"
#include "sim/plan.h"
#include "sim/scene/scene_io.h"
#include "sim/status.h"

namespace beltlife {

/// What a simulation of one range gave; stresses and life are not in it, they cost nothing.
struct RangeResult {
  std::string name;
  RunStatus status;
  RangeSummary summary;
  RangeLoad load;
  double step_s = 0;
  double simulated_s = 0;
  double processor_s = 0;                 ///< what it cost: its part of its pack's, retry included
  std::optional<double> settling_change;  ///< with early end: largest change between the last two stretches
  bool retried = false;                   ///< at half the step, after it had failed

  bool ok() const { return status.ok() && summary.complete; }
};

struct PointResult {
  std::vector<Problem> problems;                           ///< why the drive cannot be built; empty if it can
  std::string over_budget;                                 ///< in words, if a range needs more steps than allowed
  std::vector<std::shared_ptr<const RangeResult>> ranges;  ///< in the scene's order; empty if none was run
  Life life;                         ///< over the ranges, with the point's own fatigue data and shares
  std::vector<Quantity> quantities;  ///< as quantity_names lists them

  /// Whether the drive was built and every range ran to its end.
  bool ok() const;
};

struct EvaluatorOptions {
  int threads = 0;  ///< 0: as many as the machine has
  /// Drives share lanes (throughput), or each has all eight (latency). Both agree within the noise floor, not to the
  /// bit: a study keeps to one.
  LaneUse use = LaneUse::drives;
  bool retry = true;                  ///< a failed range runs once more at half its step
  std::vector<std::string> ranges;    ///< names; empty: all
  std::optional<double> step_budget;  ///< a drive of which a range needs more force evaluations is not run
  const MeasuredSpeed* measured = nullptr;
};

/// Evaluates batches of points. Results depend neither on threads nor on what else is in the batch. What was simulated
/// before is not simulated again: the memo is keyed by everything that the simulation sees, to the bit, so that points
/// which differ in rubber, fatigue data or duty shares alone share their runs.
class Evaluator {
 public:
  explicit Evaluator(EvaluatorOptions options) : options_(std::move(options)) {}

  /// `on_finished` gets a point's index and result as soon as it is whole, from any thread, one at a time, in no
  /// particular order; it may be empty. Scenes are valid (read_scene or validate). After request_stop() no pack is
  /// begun, and Interrupted is thrown unless all were.
  std::vector<PointResult> evaluate(const std::vector<SceneSpec>& points,
                                    const std::function<void(std::size_t, const PointResult&)>& on_finished = {});

  std::size_t simulations() const { return simulations_; }  ///< ranges really run, retries not counted
  std::size_t reused() const { return reused_; }            ///< ranges taken from the memo

 private:
  struct Batch;
  /// Compiles a point, unless it is refused, and notes what of it is in no memo.
  void ask_for(std::size_t point, Batch& batch);

  EvaluatorOptions options_;
  std::unordered_map<std::string, std::shared_ptr<const RangeResult>> memo_;
  std::unordered_set<std::string> paid_;  ///< keys whose cost a point has been given
  std::size_t simulations_ = 0, reused_ = 0;
};

/// What the simulation of `range` depends on, as text that names every number to the bit.
std::string simulation_key(const SceneSpec& scene, const std::string& range);

}  // namespace beltlife
