// Owns what all study files have in common: the model, its quantities and its parameters.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/scene/field.h"

namespace beltlife {

enum class DistributionKind { uniform, normal, lognormal, triangular };
template <>
struct EnumNames<DistributionKind> {
  static constexpr std::array<std::string_view, 4> names{"uniform", "normal", "lognormal", "triangular"};
};

/// How a parameter scatters; cut off at the parameter's bounds where it has them.
struct DistributionSpec {
  DistributionKind kind = DistributionKind::uniform;
  std::optional<double> mean;
  std::optional<double> standard_deviation;
  std::optional<double> mode;

  template <class V>
  void visit(V& v) {
    v("kind", kind, any_text, "uniform and triangular lie between the parameter's bounds");
    v("mean", mean, any_text, "of normal and lognormal: mean of the parameter itself");
    v("standard_deviation", standard_deviation, above(0, 1e300),
      "of normal and lognormal: of the parameter itself, not of its logarithm");
    v("mode", mode, any_text, "of triangular: the likeliest value; absent: the middle");
  }
};

struct ParameterSpec {
  std::string path;
  std::optional<double> lower;
  std::optional<double> upper;
  std::optional<double> start;
  bool log = false;
  std::optional<DistributionSpec> distribution;

  template <class V>
  void visit(V& v) {
    v("path", path, required_text,
      "a number of the scene by its path (beltlife check --json lists them); of a command: any name");
    v("lower", lower, any_text, "lower bound, in the field's unit");
    v("upper", upper, any_text, "upper bound");
    v("start", start, any_text,
      "where a search begins, and the nominal value of a study; absent: the scene's value, or the middle");
    v("log", log, any_text, "true: the driver works in ln(p); needs a positive lower bound");
    v("distribution", distribution, any_text, "scatter of the parameter; absent: uniform between the bounds");
  }
};

/// Another simulator: started once a point, a JSON object of parameters on its standard input, one of quantities on
/// its standard output.
struct CommandSpec {
  std::vector<std::string> run;
  double timeout_s = 60;

  template <class V>
  void visit(V& v) {
    v("run", run, required_text, "program and arguments; a relative program path is relative to the study file");
    v("timeout_s", timeout_s, above(0, 1e7), "a point that takes longer has failed; its process is killed");
  }
};

struct ProblemSpec {
  int format = 1;
  std::optional<std::string> scene;
  std::optional<CommandSpec> command;
  std::vector<std::string> quantities;
  std::optional<double> step_budget;
  std::vector<ParameterSpec> parameter;

  template <class V>
  void visit(V& v) {
    v("format", format, within(1, 1), "version of the format of study files");
    v("scene", scene, any_text, "scene file, relative to the study file; give exactly one of this, [command]");
    v("command", command, any_text, "another simulator in place of the embedded one");
    v("quantities", quantities, any_text, "what to record of every point; names: beltlife check --json");
    v("step_budget", step_budget, above(0, 1e15),
      "a range that needs more time steps than this (force evaluations: the thesis' scheme has two a step) is not run, "
      "and "
      "its point has timed out; absent: no limit");
    v("parameter", parameter, any_text, "what is varied");
  }

  std::vector<std::string> paths() const {
    std::vector<std::string> all;
    for (const ParameterSpec& p : parameter) all.push_back(p.path);
    return all;
  }
};

}  // namespace beltlife
