// Owns the early end of a range: whether what a window shows differs from what the window before it showed.
#pragma once

#include <vector>

#include "sim/eval/summary.h"

namespace beltlife {

/// Largest change from one block to the next of mean, lowest and highest span tensions, mean speed and torque of the
/// output and their largest order, slip: each relative to the larger of the two (slip: in per cent of the speed, to 1).
double largest_change(const RangeSummary& before, const RangeSummary& after);

/// For RunOptions::enough of a run over plan_blocks: the last two windows agree within `tolerance`.
bool settled(const Model& model, const RunRecord& record, double tolerance);

/// Keeps the last complete window of a run over plan_blocks, and says what the early end may have cost.
/// Returns the largest change between the last two windows; not a number if there was only one.
double keep_last_window(const Model& model, RunRecord& record);

}  // namespace beltlife
