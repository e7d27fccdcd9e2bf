// Owns the parts of an optimisation's answer that are about one design.
#pragma once

#include "optimize/finalists.h"
#include "optimize/search_answer.h"

namespace beltlife {

ReplicateMean answer_of(const MeanOf& mean);

DesignAnswer answer_of(const DesignRuns& runs, const Candidate& c, const Outcome& outcome);

/// What the design breaks, in words with numbers: distances first.
std::vector<std::string> violated(const DesignRuns& runs, const Candidate& c, const Outcome& outcome);

/// Limits within 1 mm or 1 degree, constraints and loads within 5 % of their bound, parameters within 1 % of the
/// bounds' distance.
std::vector<ActiveLimit> active_limits(const DesignProblem& design, const std::vector<BoundLine>& bounds,
                                       const Candidate& c, const Outcome& outcome);

/// The loop for a drawing; nothing without a layout.
OrNull<DrawnLayout> layout_of(const DesignProblem& design, const Candidate& c);

/// Which range, and which pulley over all ranges, take most of the damage, with their shares; nothing where lives are
/// not recorded. From the stresses by Basquin's and Miner's rules, as the life itself.
OrNull<GoverningPart> governing_of(const DesignProblem& design, const std::vector<double>& values);

/// Per range the mean and scatter over the replicates of log10_life_h; nothing where it is not recorded.
OrNull<RangeLives> lives_of(const DesignProblem& design, const std::vector<Outcome>& replicates);

}  // namespace beltlife
