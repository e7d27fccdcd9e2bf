// Owns what simulate and life share: running the plans of a scene, and what follows from the records.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "results/course/loaded_scene.h"
#include "results/course/options.h"
#include "results/store/results_file.h"
#include "sim/eval/run_ranges.h"
#include "sim/eval/summary.h"
#include "sim/life/loads.h"

namespace beltlife {

/// Runs all plans with progress on standard error; `wall_s` gets the time that it took, on however many threads.
std::vector<RunOutcome> run_all(const LoadedScene& scene, const std::vector<RunPlan>& plans,
                                const RangeOptions& options, double& wall_s);
std::vector<RunRecord> records_of(std::vector<RunOutcome>&& outcomes);

/// Loads of the complete windows; none of a scene without ranges.
std::vector<RangeLoad> loads_of(const LoadedScene& scene, const std::vector<RunRecord>& records);
/// A duty cycle of which a range failed has no life: that of the rest would look like an answer.
Life life_of(const LoadedScene& scene, const std::vector<RangeLoad>& loads, const std::vector<RunRecord>& records);
/// Of every window that has samples; says on standard error which have not settled.
std::vector<RangeSummary> summaries_of(const LoadedScene& scene, const std::vector<RunRecord>& records);

/// The result file, if one is asked for.
void write_file(const LoadedScene& scene, const std::vector<RunRecord>& records, const Life* life,
                const CommonOptions& options, const RunExtras& extras = {});

/// Of ranges that may end early, how each ended: a line each.
std::string settling_lines(const LoadedScene& scene, const std::vector<RunRecord>& records);

/// Failures on standard error; whether there were any.
bool report_failures(const std::vector<RunRecord>& records, const std::vector<RunPlan>& plans);
nlohmann::json json_of_runs(const std::vector<RunRecord>& records, const std::vector<RunPlan>& plans);

}  // namespace beltlife
