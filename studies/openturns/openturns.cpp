// Distributions, designs and surrogates, by the module that links OpenTURNS: see openturns_module.h.
#include <dlfcn.h>
#include <fmt/format.h>

#include <cmath>

#include "sim/scene/scene_io.h"
#include "studies/openturns/openturns_module.h"

namespace beltlife {
namespace {

constexpr const char* file = "libbeltlife_openturns.so";  // found beside the program, or in its lib/beltlife

/// Opened once and never closed. Throws BadInput if it cannot be, with the linker's reason.
const OpenTurnsModule& module() {
  static const OpenTurnsModule* const opened = [] {
    void* const library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    void* const entry = library ? dlsym(library, "beltlife_openturns_module") : nullptr;
    if (!entry) {
      const char* const reason = dlerror();
      throw BadInput(
          {Problem{file, 0, "", fmt::format("cannot be opened: {}", reason ? reason : "no reason given"),
                   "the module of this build of beltlife, and OpenTURNS (apt-get install libopenturns-dev)"}});
    }
    return reinterpret_cast<decltype(&beltlife_openturns_module)>(entry)();
  }();
  return *opened;
}

}  // namespace

Rows unit_design(SamplingMethod method, std::size_t rows, std::size_t columns, std::int64_t seed) {
  return module().unit_design(method, rows, columns, seed);
}

Inputs::Inputs(const std::vector<ParameterSpec>& parameters, const Rows& correlation)
    : margins_(module().margins(parameters, correlation)) {}

double chaos_terms(std::size_t parameters, int degree) {
  double terms = 1;
  for (int k = 1; k <= degree; ++k) terms *= (static_cast<double>(parameters) + k) / k;
  return std::round(terms);
}

Surrogate chaos_surrogate(const std::vector<ParameterSpec>& parameters, const Rows& at,
                          const std::vector<double>& values, int degree) {
  return module().chaos(parameters, at, values, degree);
}

Surrogate kriging_surrogate(const std::vector<ParameterSpec>& parameters, const Rows& at,
                            const std::vector<double>& values) {
  return module().kriging(parameters, at, values);
}

}  // namespace beltlife
