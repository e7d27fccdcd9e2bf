// Owns the group /statics of a result file, both ways.
#pragma once

#include <optional>

#include "results/store/hdf5_image.h"
#include "results/store/hdf5_source.h"
#include "sim/eval/solved_drive.h"

namespace beltlife {

/// Nothing is written for a drive without take-up and ranges.
void put_statics(Hdf5Image& file, const DriveStatics& statics);

/// Nothing from a file without the group. Of the estimated life only what the file holds: no single stresses.
std::optional<DriveStatics> read_statics(const Hdf5Source& file);

}  // namespace beltlife
