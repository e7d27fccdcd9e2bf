// Owns the parts of an optimisation's answer as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "optimize/finalists.h"

namespace beltlife {

/// {"parameters", "choices" where there are any, "quantities", "objective", "feasible", "point"}; where the design is
/// infeasible also "violated", in words; where it failed "state" and "reason", and quantities and objective are null.
nlohmann::json json_of(const DesignRuns& runs, const Candidate& c, const Outcome& outcome);

/// {"mean", "standard_deviation", "low", "high"}; null where there is none.
nlohmann::json json_of(const MeanOf& mean);

/// What the design breaks, in words with numbers: distances first.
std::vector<std::string> violated(const DesignRuns& runs, const Candidate& c, const Outcome& outcome);

/// Limits within 1 mm or 1 degree, constraints and loads within 5 % of their bound, parameters within 1 % of the
/// bounds' distance: a list of {"kind", "name", "left", "unit"}.
nlohmann::json active_of(const DesignRuns& runs, const Candidate& c, const Outcome& outcome);

/// The loop for a drawing, lengths in mm: "pulleys", "spans", "tensioner", "box", "keep_outs", "path_length_mm",
/// "tension_n", "unstretched_length_mm".
nlohmann::json layout_of(const DesignProblem& design, const Candidate& c);

/// Which range, and which pulley over all ranges, take most of the damage, with their shares; null where lives are not
/// recorded. From the stresses by Basquin's and Miner's rules, as the life itself.
nlohmann::json governing_of(const DesignProblem& design, const std::vector<double>& values);

/// Per range the mean and scatter over the replicates of log10_life_h; null where it is not recorded.
nlohmann::json lives_of(const DesignProblem& design, const std::vector<Outcome>& replicates);

}  // namespace beltlife
