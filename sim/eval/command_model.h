// Owns the model that is another program: one process a point, JSON in and out.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/eval/point.h"
#include "sim/eval/problem_spec.h"

namespace beltlife {

/// A model that starts `spec.run` for every point with a JSON object of `names` and the point's values on standard
/// input and reads a JSON object with at least `quantities` from standard output, on up to `threads` processes at once
/// (0: as many as the machine has processors). A program path with a slash is relative to `folder`, where the processes
/// run too. A point fails, in words that hold the end of standard error, if the program cannot be started, exits other
/// than 0, is killed, prints no JSON object, more than a few megabytes, or a quantity that is missing or not a finite
/// number; it is timed_out, and the process with its children killed, after spec.timeout_s.
PointModel command_model(const CommandSpec& spec, const std::filesystem::path& folder, std::vector<std::string> names,
                         std::vector<std::string> quantities, int threads);

}  // namespace beltlife
