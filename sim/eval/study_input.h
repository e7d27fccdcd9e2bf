// Owns the reading of study files: any driver's Spec from TOML, and the checks that hold for all of them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/eval/problem_spec.h"
#include "sim/scene/spec_reader.h"
#include "sim/scene/spec_writer.h"

namespace beltlife {

/// What every study file holds, and the table [study] of one kind.
template <class Settings>
struct StudySpec {
  ProblemSpec problem;
  Settings study;

  template <class V>
  void visit(V& v) {
    problem.visit(v);
    v("study", study, any_text, "settings of this kind of study");
  }
};

/// A study file with where each of its fields stands. Problems found later are added to `log` and thrown at once.
template <class Spec>
struct StudyInput {
  Spec spec;
  ReadLog log;
  std::filesystem::path path;
};

/// Reads the file; problems wait in `log`, so that those of the scene can join them. Throws BadInput where the file is
/// unreadable or no TOML.
template <class Spec>
StudyInput<Spec> read_study(const std::filesystem::path& path) {
  StudyInput<Spec> input;
  input.path = path;
  input.log.file = path.string();
  input.spec = read_spec<Spec>(parse_toml(read_text(path), input.log.file), input.log);
  return input;
}

/// Adds what is wrong with a problem by itself: neither or both of scene and command, bounds out of order, a
/// distribution that lacks its numbers, names that occur twice.
void check_problem(const ProblemSpec& problem, ReadLog& log);

/// Adds what is wrong with it on this scene: unknown paths and quantities, bounds that the field does not allow. A
/// scene whose problems are not known yet is checked no further.
void check_against_scene(const ProblemSpec& problem, const SceneSpec& scene, const std::vector<std::string>& quantities,
                         ReadLog& log);

/// Fills in what the file leaves out: a parameter's start from the scene (moved to the nearer bound if it lies
/// outside), without a scene the mean of its distribution or the middle of its bounds (of their logarithms with `log`).
void complete_starts(ProblemSpec& problem, const SceneSpec* scene);

}  // namespace beltlife
