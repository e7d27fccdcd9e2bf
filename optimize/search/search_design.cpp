// Points laid out before anything is known: see search_design.h.
#include "optimize/search/search_design.h"

#include <algorithm>
#include <numeric>

#include "optimize/search/nlopt_search.h"

namespace beltlife {

std::uint64_t SearchRandom::bits() {
  std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

double SearchRandom::uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

HaltonSequence::HaltonSequence(std::size_t variables, std::int64_t seed) {
  SearchRandom random(seed);
  for (unsigned candidate = 2; bases_.size() < variables; ++candidate) {
    const bool prime = std::all_of(bases_.begin(), bases_.end(), [&](unsigned base) { return candidate % base != 0; });
    if (!prime) continue;
    bases_.push_back(candidate);
    std::vector<unsigned> digits(candidate);
    std::iota(digits.begin(), digits.end(), 0u);
    // Zero stays: the endless zeros in front of a number would else add up to a constant.
    for (unsigned i = candidate - 1; i > 1; --i) std::swap(digits[i], digits[1 + random.bits() % i]);
    digits_.push_back(digits);
    shift_.push_back(random.uniform());
  }
}

Point HaltonSequence::next() {
  ++index_;
  Point x;
  for (std::size_t k = 0; k < bases_.size(); ++k) {
    double value = shift_[k], weight = 1.0 / bases_[k];
    for (std::uint64_t rest = index_; rest > 0; rest /= bases_[k], weight /= bases_[k])
      value += weight * digits_[k][rest % bases_[k]];
    x.push_back(value >= 1 ? value - 1 : value);
  }
  return in_cube(x);
}

Point repaired(const SearchLedger& ledger, const Point& x) {
  if (ledger.geometry_feasible(x)) return x;
  constexpr double margin = 1e-4;  // inside, so that rounding does not put it outside again
  Point best = x;
  double least = shortfall(ledger.geometry(x)), nearest = 0;
  NloptTask task(SearchAlgorithm::cobyla, x);
  task.constraints = ledger.problem().geometry_constraints;
  task.max_calls = 100 * static_cast<int>(x.size() + 1);
  task.assess = [&](const Point& at) -> std::optional<Assessed> {
    Assessed found{distance(at, x), ledger.geometry(at)};
    const double missing = shortfall(found.constraints);
    if (missing < least || (missing == least && found.objective < nearest)) {
      best = at;
      least = missing;
      nearest = found.objective;
    }
    for (double& g : found.constraints) g -= margin;
    return found;
  };
  run_nlopt(task);
  return best;
}

std::vector<Point> screened(const SearchLedger& ledger, HaltonSequence& sequence, std::size_t count) {
  const std::size_t examined = std::max<std::size_t>(4096, 4 * count);
  std::vector<Point> chosen;
  std::vector<std::pair<double, Point>> others;
  for (std::size_t i = 0; i < examined && chosen.size() < count; ++i) {
    const Point x = sequence.next();
    const double missing = shortfall(ledger.geometry(x));
    if (missing == 0)
      chosen.push_back(x);
    else
      others.emplace_back(missing, x);
  }
  std::stable_sort(others.begin(), others.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& other : others) {
    if (chosen.size() >= count) break;
    const Point x = repaired(ledger, other.second);
    if (std::find(chosen.begin(), chosen.end(), x) == chosen.end()) chosen.push_back(x);
  }
  return chosen;
}

}  // namespace beltlife
