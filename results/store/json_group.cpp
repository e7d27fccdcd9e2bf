// JSON as HDF5: see json_group.h.
#include "results/store/json_group.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "results/store/file_paths.h"
#include "sim/eval/quantity_unit.h"
#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

using nlohmann::json;

bool is_real(const json& value) { return value.is_number_float() || value.is_null(); }
bool is_boolean(const json& value) { return value.is_boolean(); }
bool is_integer(const json& value) {
  return value.is_number_integer() &&
         !(value.is_number_unsigned() && value.get<std::uint64_t>() > std::numeric_limits<std::int64_t>::max());
}
bool is_text(const json& value) {
  return value.is_string() && value.get_ref<const std::string&>().find('\0') == std::string::npos;
}

template <class Predicate>
bool all(const json& array, Predicate holds) {
  return std::all_of(array.begin(), array.end(), holds);
}

bool is_matrix(const json& array) {
  return all(array, [&](const json& row) {
    return row.is_array() && !row.empty() && row.size() == array[0].size() && all(row, is_real);
  });
}

bool has_zero(const json& object) {
  return std::any_of(object.items().begin(), object.items().end(),
                     [](const auto& item) { return item.key().find('\0') != std::string::npos; });
}

bool is_table(const json& array) {
  const auto fits = [&](const json& row) {
    if (!row.is_object() || row.empty() || row.size() != array[0].size() || has_zero(row)) return false;
    for (const auto& [key, value] : row.items())
      if (value.is_structured() || !array[0].contains(key)) return false;
    return true;
  };
  return all(array, fits);
}

double real_of(const json& value) { return value.is_null() ? std::nan("") : value.get<double>(); }
json json_of(double value) { return std::isnan(value) ? json() : json(value); }

/// What is known of a value from the list of parts of an answer. Without a note its key is all that is known.
struct Known {
  std::string_view key, about;
  const std::vector<AnswerNote>* parts = nullptr;  ///< of the answer that the value is, below its maps
  const AnswerNote* note = nullptr;
  int named = 0;                  ///< maps by name that are still to come
  std::string unit_of_name = {};  ///< of the nearest name above that has one

  std::string unit() const {
    if (!note) return beltlife::unit_of_name(key);
    return note->unit == unit_of_its_name ? unit_of_name : note->unit;
  }

  Known below(std::string_view child) const {
    Known known{child, child, nullptr, nullptr, 0, unit_of_name};
    if (named > 0) {
      const std::string unit = beltlife::unit_of_name(child);
      return {child, about, parts, note, named - 1, unit.empty() ? unit_of_name : unit};
    }
    if (!parts) return known;
    const auto at = std::find_if(parts->begin(), parts->end(), [&](const AnswerNote& n) { return n.name == child; });
    if (at == parts->end()) return known;
    return {child, at->meaning, &at->parts, &*at, at->named, unit_of_name};
  }
};

void put_known(Hdf5Image& file, const std::string& path, const json& value, const Known& known);

/// One value on its way into the file.
struct Put {
  Hdf5Image& file;
  const std::string& path;
  const Known& known;

  void child(UniqueNames& unique, const std::string& name, const json& value) const {
    put_known(file, join(path, unique.take(name)), value, known.below(name));
  }

  void object(const json& value) const {
    file.group(path, known.about);
    UniqueNames unique;
    for (const auto& [name, member] : value.items()) child(unique, name, member);
  }

  void table(const json& rows) const {
    file.group(path, known.about);
    file.attribute(path, names::json_table, static_cast<std::int64_t>(rows.size()));
    UniqueNames unique;
    for (const auto& [name, first] : rows[0].items()) {
      json column = json::array();
      for (const json& row : rows) column.push_back(row[name]);
      child(unique, name, column);
    }
  }

  void list(const json& items) const {
    file.group(path, known.about);
    file.attribute(path, names::json_list, static_cast<std::int64_t>(items.size()));
    for (std::size_t i = 0; i < items.size(); ++i) put_known(file, join(path, std::to_string(i)), items[i], known);
  }

  void text_of_json(const json& value) const {
    file.scalar(path, value.dump(), known.about);
    file.attribute(path, names::json_text, std::int64_t{1});
  }

  void array(const json& value) const {
    const auto reals = [](const json& from, std::vector<double>& to) {
      for (const json& one : from) to.push_back(real_of(one));
    };
    std::vector<double> numbers;
    if (all(value, is_real)) {
      reals(value, numbers);
      file.dataset(path, numbers, known.unit(), known.about);
    } else if (all(value, is_integer)) {
      file.dataset(path, value.get<std::vector<std::int64_t>>(), known.unit(), known.about);
    } else if (all(value, is_boolean)) {
      std::vector<std::int8_t> truths;
      for (const json& one : value) truths.push_back(one.get<bool>());
      file.truths(path, truths, known.about);
    } else if (all(value, is_text)) {
      file.dataset(path, value.get<std::vector<std::string>>(), known.about);
    } else if (is_matrix(value)) {
      for (const json& row : value) reals(row, numbers);
      file.matrix(path, numbers, value[0].size(), known.unit(), known.about);
    } else if (is_table(value)) {
      table(value);
    } else {
      list(value);
    }
  }

  void any(const json& value) const {
    if (value.is_object() && !has_zero(value))
      object(value);
    else if (value.is_array())
      array(value);
    else if (is_real(value))
      file.scalar(path, real_of(value), known.unit(), known.about);
    else if (is_integer(value))
      file.scalar(path, value.get<std::int64_t>(), known.unit(), known.about);
    else if (value.is_boolean())
      file.truth(path, value.get<bool>(), known.about);
    else if (is_text(value))
      file.scalar(path, value.get<std::string>(), known.about);
    else
      text_of_json(value);
  }
};

void put_known(Hdf5Image& file, const std::string& path, const json& value, const Known& known) {
  Put{file, path, known}.any(value);
  put_key(file, path, known.key);
}

[[noreturn]] void refuse(const Hdf5Source& file, std::string what) {
  throw BadInput({Problem{file.name(), 0, "", std::move(what), "a file that beltlife wrote"}});
}

json get_table(const Hdf5Source& file, const std::string& path, std::size_t rows) {
  json table = json::array();
  for (std::size_t i = 0; i < rows; ++i) table.push_back(json::object());
  for (const std::string& child : file.children(path)) {
    const json column = get_json(file, join(path, child));
    const std::string key = key_of_path(file, join(path, child));
    if (!column.is_array() || column.size() != rows) refuse(file, join(path, child) + " is not as long as its table");
    for (std::size_t i = 0; i < rows; ++i) table[i][key] = column[i];
  }
  return table;
}

json get_group(const Hdf5Source& file, const std::string& path) {
  if (file.has(path, names::json_table))
    return get_table(file, path, static_cast<std::size_t>(file.integer(path, names::json_table)));
  const bool list = file.has(path, names::json_list);
  json value = list ? json::array() : json::object();
  for (const std::string& child : file.children(path)) {
    const std::string at = join(path, child);
    if (list)
      value.push_back(get_json(file, at));
    else
      value[key_of_path(file, at)] = get_json(file, at);
  }
  return value;
}

/// Values as their dataset has them: alone, in a row, or in rows.
template <class T, class Convert>
json shaped(const std::vector<std::size_t>& extents, const std::vector<T>& values, Convert convert) {
  if (extents.empty()) return convert(values.at(0));
  json row = json::array();
  if (extents.size() == 1) {
    for (const T& value : values) row.push_back(convert(value));
    return row;
  }
  json rows = json::array();
  for (std::size_t i = 0; i < values.size(); ++i) {
    row.push_back(convert(values[i]));
    if (row.size() == extents[1]) rows.push_back(std::exchange(row, json::array()));
  }
  return rows;
}

}  // namespace

void put_key(Hdf5Image& file, const std::string& path, std::string_view key) {
  if (std::string_view(path).substr(path.rfind('/') + 1) != key) file.attribute(path, names::name, key);
}

std::string key_of_path(const Hdf5Source& file, const std::string& path) {
  return file.has(path, names::name) ? file.text(path, names::name) : path.substr(path.rfind('/') + 1);
}

void put_json(Hdf5Image& file, const std::string& path, const json& value, std::string_view key,
              std::string_view about) {
  put_known(file, path, value, {key, about});
}

void put_answer(Hdf5Image& file, const std::string& path, const json& answer, const std::vector<AnswerNote>& notes,
                std::string_view about) {
  const std::string_view key = std::string_view(path).substr(path.rfind('/') + 1);
  put_known(file, path, answer, {key, about, &notes});
}

json get_json(const Hdf5Source& file, const std::string& path) {
  const Hdf5Kind kind = file.kind(path);
  if (kind == Hdf5Kind::group) return get_group(file, path);
  const auto extents = file.extents(path);
  switch (kind) {
    case Hdf5Kind::integer:
      return shaped(extents, file.long_integers(path), [](std::int64_t v) { return json(v); });
    case Hdf5Kind::truth:
      return shaped(extents, file.long_integers(path), [](std::int64_t v) { return json(v != 0); });
    case Hdf5Kind::text:
      if (file.has(path, names::json_text)) {
        json value = json::parse(file.texts(path, 1)[0], nullptr, false);
        if (value.is_discarded()) refuse(file, path + " is no JSON");
        return value;
      }
      return shaped(extents, file.texts(path), [](const std::string& v) { return json(v); });
    default:
      return shaped(extents, file.numbers(path), json_of);
  }
}

}  // namespace beltlife
