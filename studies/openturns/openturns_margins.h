// Owns a parameter's distribution as an object of OpenTURNS; only the files openturns_*.cpp include it.
#pragma once

#include <openturns/Distribution.hxx>

#include "sim/eval/problem_spec.h"

namespace beltlife {

/// Distribution of p, or of ln p: where the driver works in ln p, and for lognormal, whose polynomials in p itself do
/// not span its functions.
struct Margin {
  OT::Distribution distribution;
  bool logarithm = false;

  double scale_of(double p) const { return logarithm ? std::log(p) : p; }
};

Margin margin_of(const ParameterSpec& parameter);

/// Puts OpenTURNS, whose generator and threads are the whole program's, into a known state.
void begin_openturns(std::int64_t seed);

}  // namespace beltlife
