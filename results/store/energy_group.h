// Owns the group of an energy account in a result file, both ways.
#pragma once

#include <string>

#include "results/store/hdf5_image.h"
#include "results/store/hdf5_source.h"
#include "sim/record.h"

namespace beltlife {

void put_energy(Hdf5Image& file, const std::string& at, const EnergyAccount& account);
EnergyAccount read_energy(const Hdf5Source& file, const std::string& at);

}  // namespace beltlife
