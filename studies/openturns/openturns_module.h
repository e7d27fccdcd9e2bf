// Owns the interface between the program and the module that links OpenTURNS, which is opened on first use: its hundred
// shared libraries take ten times as long to load as the program itself.
#pragma once

#include "studies/openturns/openturns_inputs.h"
#include "studies/openturns/openturns_surrogate.h"

namespace beltlife {

/// What the module can do; what each means stands with the function of that name in the headers above.
struct OpenTurnsModule {
  Rows (*unit_design)(SamplingMethod method, std::size_t rows, std::size_t columns, std::int64_t seed);
  std::shared_ptr<const Inputs::Margins> (*margins)(const std::vector<ParameterSpec>& parameters,
                                                    const Rows& correlation);
  Surrogate (*chaos)(const std::vector<ParameterSpec>& parameters, const Rows& at, const std::vector<double>& values,
                     int degree);
  Surrogate (*kriging)(const std::vector<ParameterSpec>& parameters, const Rows& at, const std::vector<double>& values);
};

/// The one function that the module shows; its name is what the program looks for.
extern "C" [[gnu::visibility("default")]] const OpenTurnsModule* beltlife_openturns_module();

}  // namespace beltlife
