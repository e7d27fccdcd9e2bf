// Owns how parameters scatter: their distributions, a correlation between them, and the designs that fill both.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "sim/eval/problem_spec.h"
#include "studies/sample.h"

namespace beltlife {

/// Points of the open unit cube: a Latin hypercube with a random place in each cell, Sobol' sequence moved by one
/// random vector modulo 1 (Cranley and Patterson, SIAM J. Numer. Anal. 13, 1976), or independent points. The same for
/// the same arguments, whatever was asked before.
Rows unit_design(SamplingMethod method, std::size_t rows, std::size_t columns, std::int64_t seed);

/// How the parameters scatter together. Each needs bounds or a distribution; without one it is uniform between its
/// bounds, with `log` in ln p. Where a parameter has bounds its distribution is cut off there.
class Inputs {
 public:
  /// `correlation`: of the normal scores that stand behind the parameters (normal copula), rows of a positive definite
  /// matrix; empty: independent. Between normal distributions it is their own correlation.
  explicit Inputs(const std::vector<ParameterSpec>& parameters, const Rows& correlation = {});

  /// Values of the parameters, each in its unit, at points of the unit cube.
  Rows at(const Rows& unit) const { return margins_->at(unit); }

  /// Where the distributions are known.
  struct Margins {
    virtual ~Margins() = default;
    virtual Rows at(const Rows& unit) const = 0;
  };

 private:
  std::shared_ptr<const Margins> margins_;
};

}  // namespace beltlife
