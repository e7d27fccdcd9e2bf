// Prints what the search algorithms achieve on problems of known optimum: share solved and what is left of the way.
//
// build/release/tests/search_comparison small [ALGORITHM...]   2 to 6 variables, 600 points, 15 seeds
// build/release/tests/search_comparison large [ALGORITHM...]   12 variables, 300 and 600 points, 5 seeds
// SEEDS=n in the environment: other numbers of seeds; FIRST=n: the first of them (1), to see what tuning on some hid.
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>

#include "optimize/search/search.h"
#include "tests/unit/search_problems.h"

namespace {

using namespace beltlife;
using namespace beltlife::search_test;

struct Condition {
  const char* name;
  Trouble trouble;
  double noise_of_range = 0;  ///< of the way from a typical design to the optimum
};

std::vector<double> ways_left(const KnownProblem& known, const Condition& condition, SearchAlgorithm algorithm,
                              int budget, int seeds) {
  const double typical = typical_objective(known);
  Trouble trouble = condition.trouble;
  trouble.absolute_noise = condition.noise_of_range * (typical - known.optimum);
  std::vector<double> left;
  const char* first = std::getenv("FIRST");
  const int from = first ? std::atoi(first) : 1;
  for (int seed = from; seed < from + seeds; ++seed) {
    const SearchProblem problem = problem_of(known, trouble, seed);
    const SearchResult result = search(problem, {.algorithm = algorithm, .budget = budget, .seed = seed});
    left.push_back(way_left(known, result.history, typical));
  }
  std::sort(left.begin(), left.end());
  return left;
}

int solved(const std::vector<double>& left) {
  return static_cast<int>(std::count_if(left.begin(), left.end(), [](double v) { return v <= 0.01; }));
}

void small_table(const std::vector<SearchAlgorithm>& algorithms, int seeds) {
  const std::vector<Condition> conditions{{"exact", {}, 0},
                                          {"noise 1 % of f", {.noise = 0.01}, 0},
                                          {"of range", {}, 0.01},
                                          {"10 % fail", {.failures = 0.1}, 0},
                                          {"fails outside", {.fails_outside = true}, 0}};
  const auto problems = small_problems();
  for (const SearchAlgorithm algorithm : algorithms)
    for (const Condition& condition : conditions) {
      fmt::print("{:18} {:14}", enum_name(algorithm), condition.name);
      int sum = 0;
      for (const KnownProblem& known : problems) {
        const int count = solved(ways_left(known, condition, algorithm, 600, seeds));
        sum += count;
        fmt::print(" {:3}", count);
        std::fflush(stdout);
      }
      fmt::print("  {:5.1f} %\n", 100.0 * sum / static_cast<double>(problems.size() * seeds));
    }
}

void large_table(const std::vector<SearchAlgorithm>& algorithms, int seeds) {
  const std::vector<Condition> conditions{{"exact", {}, 0}, {"of range", {}, 0.01}};
  for (const KnownProblem& known : large_problems())
    for (const Condition& condition : conditions)
      for (const SearchAlgorithm algorithm : algorithms)
        for (const int budget : {300, 600}) {
          const auto start = std::chrono::steady_clock::now();
          const auto left = ways_left(known, condition, algorithm, budget, seeds);
          const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
          fmt::print("{:8} {:10} {:18} {:4}  median {:8.4f}  worst {:8.4f}  solved {}/{}  {:.1f} s a search\n",
                     known.name, condition.name, enum_name(algorithm), budget, left[left.size() / 2], left.back(),
                     solved(left), seeds, took.count() / seeds);
          std::fflush(stdout);
        }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view size = argc > 1 ? argv[1] : "small";
  std::vector<SearchAlgorithm> chosen;
  const auto& names = EnumNames<SearchAlgorithm>::names;
  for (int i = 2; i < argc; ++i) {
    const auto found = std::find(names.begin(), names.end(), argv[i]);
    if (found == names.end()) {
      fmt::print(stderr, "no algorithm '{}'\n", argv[i]);
      return 1;
    }
    chosen.push_back(static_cast<SearchAlgorithm>(found - names.begin()));
  }
  const char* seeds = std::getenv("SEEDS");
  using enum SearchAlgorithm;
  if (size == "large") {
    if (chosen.empty()) chosen = {kriging, cobyla_multistart, cobyla, crs2_cobyla, crs2, random};
    large_table(chosen, seeds ? std::atoi(seeds) : 5);
  } else {
    if (chosen.empty())
      chosen = {automatic, cobyla_multistart, cobyla, crs2, isres, esch, direct_l, bobyqa, neldermead, sbplx, random};
    small_table(chosen, seeds ? std::atoi(seeds) : 15);
  }
}
