// Searches over designs: see design_search.h.
#include "optimize/design_search.h"

#include <algorithm>

#include "optimize/search/feasible_design.h"

namespace beltlife {

bool better(const OptimizationSpec& spec, double a, double b) { return spec.objective.maximize ? a > b : a < b; }
bool better_second(const OptimizationSpec& spec, double a, double b) { return spec.pareto->maximize ? a > b : a < b; }

std::vector<Trial> DesignSearch::evaluate(std::size_t combination, const std::vector<Design>& designs,
                                          const SearchAim& aim) {
  const OptimizationSpec& spec = runs_.design().spec();
  std::vector<Candidate> candidates;
  for (const Design& x : designs) candidates.push_back({combination, x});
  std::vector<Outcome> outcomes = runs_.evaluate(candidates, {coarse_, 0}, "search");
  std::vector<Trial> trials;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const Outcome& o = outcomes[i];
    Trial t;
    t.x = designs[i];
    t.ok = o.ok();
    t.geometry = runs_.design().geometry(candidates[i]);
    if (t.ok) {
      const bool large = aim.second ? spec.pareto->maximize : spec.objective.maximize;
      t.objective = (large ? -1 : 1) * (aim.second ? o.second : o.objective);
      t.constraints = runs_.scaled(o);
    }
    const double violation = t.violation();
    const bool feasible = t.feasible();
    if (t.ok && aim.second_bound)
      t.constraints.push_back((spec.pareto->maximize ? 1 : -1) * (o.second - *aim.second_bound) / aim.second_scale);
    trials.push_back(std::move(t));
    simulations_ += runs_.simulations();
    tried_.push_back({candidates[i], std::move(outcomes[i]), feasible, violation, simulations_});
  }
  return trials;
}

SearchProblem DesignSearch::problem(std::size_t combination, const Design& start, const SearchAim& aim) {
  const DesignProblem& design = runs_.design();
  SearchProblem p;
  p.variables = design.variables();
  p.start = start;
  p.constraints = runs_.constraints() + (aim.second_bound ? 1 : 0);
  p.geometry_constraints = design.geometry({combination, start}).size();
  if (p.geometry_constraints > 0)
    p.geometry = [&design, combination](const Design& x) { return design.geometry({combination, x}); };
  p.evaluate = [this, combination, aim](const std::vector<Design>& designs) {
    return evaluate(combination, designs, aim);
  };
  return p;
}

std::string DesignSearch::run(const Candidate& start, const SearchAim& aim, std::size_t simulations,
                              std::int64_t seed) {
  const OptimizationSettings& o = runs_.design().spec().optimization;
  SearchOptions options;
  options.algorithm = o.algorithm;
  options.budget = static_cast<int>(std::max<std::size_t>(1, simulations / runs_.simulations()));
  options.seed = seed;
  options.xtol = o.xtol;
  options.batch = o.batch;
  return search(problem(start.combination, start.x, aim), options).ended;
}

StartingPoints starting_points(DesignSearch& search, const DesignProblem& design) {
  StartingPoints found;
  const std::int64_t seed = design.spec().optimization.seed;
  for (std::size_t c = 0; c < design.combinations(); ++c) {
    const Candidate start{c, design.start().x};
    if (c == 0 || shortfall(design.geometry(start)) == 0) {
      found.starts.push_back(start);
      continue;
    }
    const auto designs = feasible_designs(search.problem(c, start.x, {}), 1, seed);
    if (designs.empty())
      found.without_layout.push_back(c);
    else
      found.starts.push_back({c, designs.front()});
  }
  return found;
}

}  // namespace beltlife
