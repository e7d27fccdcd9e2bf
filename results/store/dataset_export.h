// Owns the way from datasets of an HDF5 file to a list of them and to CSV.
#pragma once

#include <string>
#include <vector>

#include "results/store/hdf5_source.h"

namespace beltlife {

/// A dataset as a list shows it.
struct DatasetEntry {
  std::string path;                ///< without the slash in front
  std::string type;                ///< "number", "integer", "yes or no", "text"
  std::vector<std::size_t> shape;  ///< empty: a single value
  std::string unit, description;   ///< empty where the file says nothing
};

/// Every dataset of the file, groups in the order in which they were written.
std::vector<DatasetEntry> datasets_of(const Hdf5Source& file);

/// What `wanted` names, side by side as CSV; each names a dataset, or a group, which stands for the datasets directly
/// in it. The header has `name [unit]`, with the path in place of the name where names repeat. A row is an entry along
/// the first extent; of more extents each entry is a column, `name[3] [unit]`; a single value is one row. Throws
/// BadInput for names that are not there, for groups without datasets, and for datasets of different lengths.
std::string datasets_csv(const Hdf5Source& file, const std::vector<std::string>& wanted);

}  // namespace beltlife
