// Owns a parameter's distribution as an object of OpenTURNS; and what the files of the module give each other.
#pragma once

#include <openturns/Distribution.hxx>

#include "studies/openturns/openturns_module.h"

namespace beltlife::openturns {

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

Rows design(SamplingMethod method, std::size_t rows, std::size_t columns, std::int64_t seed);
std::shared_ptr<const Inputs::Margins> margins(const std::vector<ParameterSpec>& parameters, const Rows& correlation);
Surrogate chaos(const std::vector<ParameterSpec>& parameters, const Rows& at, const std::vector<double>& values,
                int degree);
Surrogate kriging(const std::vector<ParameterSpec>& parameters, const Rows& at, const std::vector<double>& values);

}  // namespace beltlife::openturns
