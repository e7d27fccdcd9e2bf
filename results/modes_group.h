// Owns the group /modes of a result file, both ways.
#pragma once

#include <optional>

#include "results/hdf5_image.h"
#include "results/hdf5_source.h"
#include "results/solved_drive.h"

namespace beltlife {

/// Nothing is written for a drive without pulleys.
void put_modes(Hdf5Image& file, const Model& model, const DriveModes& modes);

/// Nothing from a file without the group. Of the operating point about which a drive was linearised, only speed,
/// tensions and doubts are in the file.
std::optional<DriveModes> read_modes(const Hdf5Source& file);

}  // namespace beltlife
