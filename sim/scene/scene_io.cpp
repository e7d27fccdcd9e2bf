// Owns the way between scene files and SceneSpec, put together from the readers and writers that serve any Spec.
#include "sim/scene/scene_io.h"

#include <fmt/format.h>

#include <cmath>
#include <concepts>
#include <utility>

#include "sim/scene/scene_check.h"
#include "sim/scene/spec_path.h"
#include "sim/scene/spec_reader.h"
#include "sim/scene/spec_writer.h"
#include "sim/scene/toml_tree.h"

namespace beltlife {
namespace {

constexpr std::string_view setting_name = "--set";  ///< stands for the file in problems of a setting

std::string lines_of(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems) {
    if (!text.empty()) text += '\n';
    text += to_string(problem);
  }
  return text;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  return first == text.npos ? std::string_view{} : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Applies one setting; problems go to log, and what the file says about the field counts no longer.
void apply_setting(SceneSpec& scene, std::string_view setting, ReadLog& log) {
  const std::size_t equals = setting.find('=');
  const std::string path(trimmed(setting.substr(0, equals)));
  Problem problem{std::string(setting_name), 0, path, "", ""};
  if (equals == setting.npos || path.empty()) {
    problem.what = fmt::format("'{}' is no setting", setting);
    problem.allowed = "PATH=VALUE";
    log.problems.push_back(std::move(problem));
    return;
  }
  std::string place;
  const Faults faults = set_by_text(scene, path, trimmed(setting.substr(equals + 1)), place);
  for (const Fault& fault : faults) {
    log.problems.push_back({problem.file, 0, path + fault.suffix, fault.what, fault.allowed});
  }
  if (faults.empty()) log.lines[place] = 0;
  if (!faults.empty() && !place.empty()) log.faulty.insert(place);
}

[[noreturn]] void refuse_path(SceneSpec& scene, std::string_view path) {
  std::vector<std::string> absent;
  const std::vector<std::string> paths = all_paths(scene, absent);
  const Fault fault = explain_unknown_path(path, paths, absent);
  throw BadInput({Problem{"parameter", 0, std::string(path), fault.what, fault.allowed}});
}

[[noreturn]] void refuse_kind(std::string_view path, std::string what) {
  throw BadInput({Problem{"parameter", 0, std::string(path), std::move(what), ""}});
}

template <class T>
concept NumberType = std::floating_point<T> || IntegerType<T>;

}  // namespace

std::string to_string(const Problem& problem) {
  std::string text = problem.file;
  if (problem.line > 0) text += fmt::format(":{}", problem.line);
  if (!problem.key.empty()) text += (text.empty() ? "" : ": ") + problem.key;
  text += (text.empty() ? "" : ": ") + problem.what;
  if (!problem.allowed.empty()) text += fmt::format(" (allowed: {})", problem.allowed);
  return text;
}

BadInput::BadInput(std::vector<Problem> problems)
    : std::runtime_error(lines_of(problems)), problems_(std::move(problems)) {}

namespace {

/// Text to a checked scene; `log` keeps where each field stands.
SceneSpec parse(std::string_view text, const std::vector<std::string>& settings, ReadLog& log) {
  SceneSpec scene = read_spec<SceneSpec>(parse_toml(text, log.file), log);
  for (const std::string& setting : settings) apply_setting(scene, setting, log);
  check_scene(scene, log);
  throw_problems(std::move(log.problems));
  return scene;
}

}  // namespace

SceneSpec parse_scene(std::string_view text, std::string_view name, const std::vector<std::string>& settings) {
  ReadLog log;
  log.file = name;
  return parse(text, settings, log);
}

SceneFile read_scene(const std::filesystem::path& path, const std::vector<std::string>& settings) {
  ReadLog log;
  log.file = path.string();
  SceneFile file{{}, path, read_text(path), {}};
  file.scene = parse(file.text, settings, log);
  file.lines = std::move(log.lines);
  return file;
}

BadInput located(const SceneFile& file, const BadInput& bad) {
  SceneSpec copy = file.scene;  // visit() is not const
  ReadLog log;
  log.lines = file.lines;
  std::vector<Problem> problems = bad.problems();
  for (Problem& problem : problems) {
    if (problem.line > 0) continue;
    std::string where = problem.key;  // a whole list, "pulley", stands where it says
    at_path(copy, problem.key, [&](auto&, const Rule&, const std::string& place) { where = place; });
    problem.line = log.line(where);  // of a field that the file leaves out: its table's
  }
  return BadInput(std::move(problems));
}

std::string write_scene(const SceneSpec& scene) { return write_spec(scene); }

void set_field(SceneSpec& scene, std::string_view setting) {
  ReadLog log;
  apply_setting(scene, setting, log);
  throw_problems(std::move(log.problems));
}

double get_number(const SceneSpec& scene, std::string_view path) {
  SceneSpec copy = scene;  // visit() is not const
  double number = 0;
  const auto get = [&]<class T>(const T& value, const Rule&, const std::string&) {
    if constexpr (NumberType<T>) {
      number = static_cast<double>(value);
    } else if constexpr (std::same_as<T, std::optional<double>>) {
      if (!value) refuse_kind(path, "has no value in this scene");
      number = *value;
    } else {
      refuse_kind(path, "is not a number but " + type_words<T>());
    }
  };
  if (!at_path(copy, path, get)) refuse_path(copy, path);
  return number;
}

void set_number(SceneSpec& scene, std::string_view path, double number) {
  Faults faults;
  const auto set = [&]<class T>(T& value, const Rule& rule, const std::string&) {
    if constexpr (IntegerType<T>) {
      const bool whole = std::trunc(number) == number && std::abs(number) < 1e15;
      assign(value, whole ? TomlNode{0, static_cast<std::int64_t>(number)} : TomlNode{0, number}, rule, faults);
    } else if constexpr (NumberType<T> || std::same_as<T, std::optional<double>>) {
      assign(value, TomlNode{0, number}, rule, faults);
    } else {
      refuse_kind(path, "is not a number but " + type_words<T>());
    }
  };
  if (!at_path(scene, path, set)) refuse_path(scene, path);
  if (!faults.empty()) {
    throw BadInput({Problem{"parameter", 0, std::string(path), faults[0].what, faults[0].allowed}});
  }
}

std::vector<std::string> number_paths(const SceneSpec& scene) {
  SceneSpec copy = scene;
  std::vector<std::string> paths;
  for_each_leaf(copy, [&]<class T>(const SpecPath& leaf, T& value, const Rule&) {
    if constexpr (NumberType<T>) {
      paths.push_back(leaf.shown);
    } else if constexpr (std::same_as<T, std::optional<double>>) {
      if (value) paths.push_back(leaf.shown);
    } else if constexpr (std::same_as<T, std::vector<double>>) {
      for (std::size_t i = 0; i < value.size(); ++i) paths.push_back(leaf.element(i).shown);
    }
  });
  return paths;
}

std::string field_reference() {
  return "# Fields of a scene file\n\nA path for --set and for parameters is table.key, or table.name.key in a list of "
         "tables (table.index.key where they have no names, counted from 0).\n" +
         reference_of<SceneSpec>();
}

void validate(const SceneSpec& scene, std::string_view name) {
  ReadLog log;
  log.file = name;
  check_scene(scene, log);
  throw_problems(std::move(log.problems));
}

}  // namespace beltlife
