// Owns the early end of a range: whether what a window shows differs from what the window before it showed.
#pragma once

#include "sim/eval/summary.h"

namespace beltlife {

/// Largest change from one block to the next of mean, lowest and highest span tensions, mean speed and torque of the
/// output and their largest order, slip: each relative to the larger of the two (slip: in per cent of the speed, to 1).
double largest_change(const RangeSummary& before, const RangeSummary& after);

/// For RunOptions::enough of a run over plan_blocks: the last two windows agree within `tolerance`.
bool settled(const Model& model, const RunRecord& record, double tolerance);

/// Keeps one window of a run over plan_blocks, the last complete one, and records its change from the one before it:
/// what the early end may have cost. A failed run keeps the window in which it failed, or was to open next: that an
/// earlier one is whole must not pass for a result.
void keep_last_window(const Model& model, RunRecord& record);

}  // namespace beltlife
