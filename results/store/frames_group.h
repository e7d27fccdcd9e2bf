// Owns the group of a range's frames in an HDF5 result file, both ways.
#pragma once

#include <string>

#include "results/store/hdf5_image.h"
#include "results/store/hdf5_source.h"
#include "sim/record.h"

namespace beltlife {

/// Writes the group `at`; nothing if there are no frames.
void put_frames(Hdf5Image& file, const std::string& at, const Frames& frames);

/// None where the file has no such group. Throws BadInput if its matrices do not belong together.
Frames read_frames(const Hdf5Source& file, const std::string& at);

}  // namespace beltlife
