// Owns JSON as HDF5: objects as groups, arrays as datasets, rows of objects as tables, and the way back.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "results/answer/answer_note.h"
#include "results/store/hdf5_image.h"
#include "results/store/hdf5_source.h"

namespace beltlife {

/// Puts a JSON value at a path whose parent exists. An object is a group with its keys in order; a number, text, yes or
/// no a dataset without dimension, integers 64 bits wide; an array of one of these a dataset; rows of numbers equally
/// long a dataset of two dimensions; an array of objects with the same keys and no further depth a group of columns
/// (attribute `table`: its rows); any other array a group whose children are numbered (attribute `list`: how many).
/// null is NaN. What HDF5 cannot hold (texts with a zero, integers beyond 63 bits) is a text of JSON (attribute
/// `json`). A key that no path can spell stands in the attribute `name`; its unit is read off the key.
void put_json(Hdf5Image& file, const std::string& path, const nlohmann::json& value, std::string_view key,
              std::string_view about);

/// The same of an answer, with units and meanings from its list of parts. What the list does not name has its key as
/// meaning, and a unit read off that.
void put_answer(Hdf5Image& file, const std::string& path, const nlohmann::json& answer,
                const std::vector<AnswerNote>& notes, std::string_view about);

/// Reads back what put_json wrote: the same JSON, but that a NaN has become null. Throws BadInput.
nlohmann::json get_json(const Hdf5Source& file, const std::string& path);

/// The key to which a path belongs: its last part, or the attribute `name`.
std::string key_of_path(const Hdf5Source& file, const std::string& path);

/// Puts the attribute `name` where the path does not end in the key.
void put_key(Hdf5Image& file, const std::string& path, std::string_view key);

}  // namespace beltlife
