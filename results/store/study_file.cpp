// The HDF5 file of a study: see study_file.h.
#include "results/store/study_file.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "results/journal/journal.h"
#include "results/journal/journal_text.h"
#include "results/store/file_paths.h"
#include "results/store/hdf5_source.h"
#include "results/store/json_group.h"
#include "results/store/whole_file.h"
#include "sim/eval/quantity_unit.h"
#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

using nlohmann::json;

[[noreturn]] void refuse(const std::filesystem::path& path, std::string what, std::string allowed) {
  throw BadInput({Problem{path.string(), 0, "", std::move(what), std::move(allowed)}});
}

struct HeadText {
  std::string_view name;
  std::string StudyHead::*text;
};
constexpr HeadText head_texts[] = {{names::root_driver, &StudyHead::driver},
                                   {names::root_version, &StudyHead::version},
                                   {names::root_revision, &StudyHead::revision},
                                   {names::root_compiler, &StudyHead::compiler},
                                   {names::root_command_line, &StudyHead::command_line},
                                   {names::root_scene_path, &StudyHead::scene_path},
                                   {names::root_scene_text, &StudyHead::scene_text},
                                   {names::root_study_path, &StudyHead::study_path},
                                   {names::root_study_text, &StudyHead::study_text},
                                   {names::root_lanes, &StudyHead::lanes}};

void put_head(Hdf5Image& file, const StudyHead& head) {
  file.attribute("/", "description", "study of a belt drive; results/store/study_files.md explains every name");
  file.attribute("/", names::root_format, std::int64_t{names::format});
  file.attribute("/", names::root_program, "beltlife");
  file.attribute("/", names::root_kind, names::study);
  for (const auto& [name, text] : head_texts) file.attribute("/", name, head.*text);
}

template <class Value>
auto column(const std::vector<StudyPoint>& points, Value value) {
  std::vector<std::decay_t<decltype(value(points[0]))>> values;
  for (const StudyPoint& point : points) values.push_back(value(point));
  return values;
}

void put_points(Hdf5Image& file, const StudyRecord& record) {
  const std::string at(names::points), parameters(names::parameters), quantities(names::quantities);
  const auto& points = record.points;
  file.group(at, "points that were evaluated, one entry each in every column");
  const auto numbers = column(points, [](const StudyPoint& p) { return static_cast<std::int64_t>(p.number); });
  file.dataset(join(at, names::point_number.name), numbers, names::point_number.unit, names::point_number.about);
  put(file, at, names::point_state,
      column(points, [](const auto& p) { return std::string(to_string(p.answer.state)); }));
  put(file, at, names::point_reason, column(points, [](const auto& p) { return p.answer.reason; }));
  put(file, at, names::point_processor_s, column(points, [](const auto& p) { return p.answer.processor_s; }));

  file.group(parameters, "settings, one dataset a parameter, in the study's order");
  UniqueNames unique;
  for (std::size_t i = 0; i < record.head.parameters.size(); ++i) {
    json settings = json::array();
    for (const StudyPoint& p : points) std::visit([&](const auto& value) { settings.push_back(value); }, p.settings[i]);
    const std::string& name = record.head.parameters[i];
    put_json(file, join(parameters, unique.take(name)), settings, name, "value of this parameter");
  }
  file.group(quantities, "answers, one dataset a quantity, in the study's order; NaN where a point is not ok");
  unique = {};
  for (std::size_t i = 0; i < record.head.quantities.size(); ++i) {
    const std::string& name = record.head.quantities[i];
    const std::string path = join(quantities, unique.take(name));
    file.dataset(path, column(points, [&](const auto& p) { return p.answer.ok() ? p.answer.values[i] : std::nan(""); }),
                 unit_of_name(name), "value of this quantity");
    put_key(file, path, name);
  }
}

std::vector<StudyPoint> get_points(const Hdf5Source& file, const std::filesystem::path& path, StudyHead& head) {
  const std::string at(names::points), parameters(names::parameters), quantities(names::quantities);
  const auto numbers = file.long_integers(join(at, names::point_number.name));
  const std::size_t rows = numbers.size();
  const auto states = file.texts(join(at, names::point_state.name), rows);
  const auto reasons = file.texts(join(at, names::point_reason.name), rows);
  const auto processor_s = file.numbers(join(at, names::point_processor_s.name), rows);
  std::vector<StudyPoint> points(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    const auto* const state = std::find(point_state_names.begin(), point_state_names.end(), states[i]);
    if (state == point_state_names.end())
      refuse(path, "has a point of unknown state '" + states[i] + "'", "a study that this version of beltlife wrote");
    points[i].number = static_cast<std::size_t>(numbers[i]);
    points[i].answer.state = static_cast<PointState>(state - point_state_names.begin());
    points[i].answer.reason = reasons[i];
    points[i].answer.processor_s = processor_s[i];
  }
  for (const std::string& child : file.children(parameters)) {
    head.parameters.push_back(key_of_path(file, join(parameters, child)));
    const json settings = get_json(file, join(parameters, child));
    if (!settings.is_array() || settings.size() != rows)
      refuse(path, join(parameters, child) + " is not as long as the columns beside it", "");
    for (std::size_t i = 0; i < rows; ++i) {
      if (settings[i].is_string())
        points[i].settings.emplace_back(settings[i].get<std::string>());
      else if (settings[i].is_number())
        points[i].settings.emplace_back(settings[i].get<double>());
      else
        refuse(path, join(parameters, child) + " holds what is neither a number nor a text", "");
    }
  }
  for (const std::string& child : file.children(quantities)) {
    head.quantities.push_back(key_of_path(file, join(quantities, child)));
    const auto values = file.numbers(join(quantities, child), rows);
    for (std::size_t i = 0; i < rows; ++i)
      if (points[i].answer.ok()) points[i].answer.values.push_back(values[i]);
  }
  return points;
}

bool is_hdf5(const std::filesystem::path& path) {
  constexpr std::string_view signature = "\x89HDF\r\n\x1a\n";
  std::string first(signature.size(), '\0');
  std::ifstream(path, std::ios::binary).read(first.data(), static_cast<std::streamsize>(first.size()));
  return first == signature;
}

}  // namespace

void write_study(const std::filesystem::path& path, const StudyRecord& record, const std::vector<AnswerNote>& notes) {
  Hdf5Image file;
  put_head(file, record.head);
  put_points(file, record);
  if (!record.answer.is_null())
    put_answer(file, std::string(names::answer), record.answer, notes, "what the driver found");
  write_whole_file(path, file.bytes());
}

StudyRecord read_study_file(const std::filesystem::path& path) {
  const Hdf5Source file(path.string());
  if (!file.has("/", names::root_kind) || file.text("/", names::root_kind) != names::study)
    refuse(path, "holds no study", "a file that a study, a calibration or an optimisation wrote");
  if (const auto format = file.integer("/", names::root_format); format != names::format)
    refuse(path, "is of format " + std::to_string(format), "format " + std::to_string(names::format));
  StudyRecord record;
  for (const auto& [name, text] : head_texts) record.head.*text = file.text("/", name);
  record.points = get_points(file, path, record.head);
  const std::string answer(names::answer);
  if (file.kind(answer) != Hdf5Kind::nothing) record.answer = get_json(file, answer);
  return record;
}

StudyRecord read_study_record(const std::filesystem::path& path) {
  return is_hdf5(path) ? read_study_file(path) : read_journal(path);
}

bool is_study(const std::filesystem::path& path) {
  if (!is_hdf5(path)) return begins_as_journal(path);
  const Hdf5Source file(path.string());
  return file.has("/", names::root_kind) && file.text("/", names::root_kind) == names::study;
}

}  // namespace beltlife
