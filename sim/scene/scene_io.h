// Owns the way between a scene file and a SceneSpec: reading with located problems, writing, --set, parameter paths.
#pragma once

#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "sim/scene/scene.h"

namespace beltlife {

/// One thing wrong with an input. `line` is 0 where no line can be named (a --set, a missing file).
struct Problem {
  std::string file;
  int line = 0;
  std::string key;      ///< dotted path as --set spells it, e.g. pulley.idler_2.x_mm
  std::string what;     ///< what is wrong
  std::string allowed;  ///< what is allowed; may be empty
};

/// "file:line: key: what (allowed: ...)"
std::string to_string(const Problem& problem);

/// Bad input, at the boundary: all problems at once. what() is one problem a line.
class BadInput : public std::runtime_error {
 public:
  explicit BadInput(std::vector<Problem> problems);
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

/// A scene with where it came from.
struct SceneFile {
  SceneSpec scene;
  std::filesystem::path path;
  std::string text;                  ///< the file as read
  std::map<std::string, int> lines;  ///< where each field stands; for located()
};

/// The same problems with the file's lines, where their keys name fields of this file: for refusals that come after
/// reading, of layouts that cannot be built.
BadInput located(const SceneFile& file, const BadInput& bad);

/// Reads a scene file, applies `settings` ("PATH=VALUE", as of --set) in order, and checks everything that can be
/// checked without geometry: keys, types, limits, unique names, references, table lengths and order, belt length
/// given exactly once, duty shares. Throws BadInput with every problem found.
SceneFile read_scene(const std::filesystem::path& path, const std::vector<std::string>& settings = {});

/// The same from text; `name` stands for the file in messages.
SceneSpec parse_scene(std::string_view text, std::string_view name, const std::vector<std::string>& settings = {});

/// The scene as TOML that reads back to the same bits.
std::string write_scene(const SceneSpec& scene);

/// Sets one field by path from text: "tensioner.friction_torque_n_m=3.5", "range.B100.crank_rpm=1400",
/// "solver.scheme=thesis". An absent optional section cannot be created. Throws BadInput.
void set_field(SceneSpec& scene, std::string_view setting);

/// Numeric fields by path (parameters): value, in the field's own unit. Throws BadInput for an unknown or non-numeric
/// path.
double get_number(const SceneSpec& scene, std::string_view path);
void set_number(SceneSpec& scene, std::string_view path, double value);

/// Every numeric path of this scene, in field order.
std::vector<std::string> number_paths(const SceneSpec& scene);

/// Table of every field, its type, default, limits and meaning, as Markdown.
std::string field_reference();

/// The checks of read_scene that hold for any SceneSpec, also one made in code. Throws BadInput.
void validate(const SceneSpec& scene, std::string_view name = "scene");

}  // namespace beltlife
