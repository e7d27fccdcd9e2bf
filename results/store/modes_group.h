// Owns the group /modes of a result file, both ways.
#pragma once

#include <optional>
#include <string>

#include "results/store/hdf5_image.h"
#include "results/store/hdf5_source.h"
#include "sim/eval/solved_drive.h"

namespace beltlife {

/// Nothing is written for a drive without pulleys.
void put_modes(Hdf5Image& file, const Model& model, const DriveModes& modes);

/// Nothing from a file without the group. Of the operating point about which a drive was linearised, only speed,
/// tensions and doubts are in the file.
std::optional<DriveModes> read_modes(const Hdf5Source& file);

/// Natural frequencies over crank speed as a group of their own at `at`, whose parent exists; nothing is read if there
/// is no such group. The states of a map are not in a file.
void put_map(Hdf5Image& file, const std::string& at, const Campbell& map);
Campbell read_map(const Hdf5Source& file, const std::string& at);
/// Likewise where orders meet them.
void put_crossings(Hdf5Image& file, const std::string& at, const std::vector<Crossing>& crossings);
std::vector<Crossing> read_crossings(const Hdf5Source& file, const std::string& at);

}  // namespace beltlife
