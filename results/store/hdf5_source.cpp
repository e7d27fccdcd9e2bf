// Reading from an HDF5 file: see hdf5_source.h.
#include "results/store/hdf5_source.h"

#include <hdf5.h>

#include <algorithm>
#include <filesystem>

#include "sim/scene/scene_io.h"

namespace beltlife {

struct Hdf5Source::File {
  std::string name;
  hid_t id = -1;

  [[noreturn]] void refuse(const std::string& what) const {
    throw BadInput({Problem{name, 0, "", what, "a result file that beltlife wrote with --out"}});
  }
};

namespace {

/// Closes an identifier at the end of a scope.
struct Closer {
  hid_t id;
  herr_t (*close)(hid_t);
  ~Closer() {
    if (id >= 0) close(id);
  }
};

}  // namespace

Hdf5Source::Hdf5Source(const std::string& name) : file_(std::make_unique<File>()) {
  file_->name = name;
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  if (!std::filesystem::is_regular_file(name)) file_->refuse("no such file");
  file_->id = H5Fopen(name.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file_->id < 0) file_->refuse("is not a whole HDF5 file");
}

Hdf5Source::~Hdf5Source() {
  if (file_->id >= 0) H5Fclose(file_->id);
}

const std::string& Hdf5Source::name() const { return file_->name; }

std::vector<std::string> Hdf5Source::children(const std::string& path) const {
  std::vector<std::string> names;
  const Closer group{H5Gopen2(file_->id, path.c_str(), H5P_DEFAULT), H5Gclose};
  if (group.id < 0) return names;
  const auto take = [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t {
    static_cast<std::vector<std::string>*>(out)->push_back(name);
    return 0;
  };
  hsize_t at = 0;
  if (H5Literate(group.id, H5_INDEX_CRT_ORDER, H5_ITER_INC, &at, take, &names) < 0) {
    names.clear();
    at = 0;
    H5Literate(group.id, H5_INDEX_NAME, H5_ITER_INC, &at, take, &names);
  }
  return names;
}

Hdf5Kind Hdf5Source::kind(const std::string& path) const {
  if (path != "/" && H5Lexists(file_->id, path.c_str(), H5P_DEFAULT) <= 0) return Hdf5Kind::nothing;
  const Closer object{H5Oopen(file_->id, path.c_str(), H5P_DEFAULT), H5Oclose};
  if (object.id < 0) return Hdf5Kind::nothing;
  if (H5Iget_type(object.id) != H5I_DATASET) return Hdf5Kind::group;
  const Closer type{H5Dget_type(object.id), H5Tclose};
  switch (H5Tget_class(type.id)) {
    case H5T_FLOAT:
      return Hdf5Kind::real;
    case H5T_INTEGER:
      return Hdf5Kind::integer;
    case H5T_ENUM:
      return Hdf5Kind::truth;
    case H5T_STRING:
      return Hdf5Kind::text;
    default:
      file_->refuse(path + " is of a type that beltlife does not write");
  }
}

std::vector<std::size_t> Hdf5Source::extents(const std::string& path) const {
  const Closer set{H5Dopen2(file_->id, path.c_str(), H5P_DEFAULT), H5Dclose};
  if (set.id < 0) file_->refuse("has no " + path);
  const Closer space{H5Dget_space(set.id), H5Sclose};
  std::vector<hsize_t> sides(static_cast<std::size_t>(std::max(H5Sget_simple_extent_ndims(space.id), 0)));
  if (!sides.empty()) H5Sget_simple_extent_dims(space.id, sides.data(), nullptr);
  return {sides.begin(), sides.end()};
}

std::vector<double> Hdf5Source::numbers(const std::string& path) const {
  const Closer set{H5Dopen2(file_->id, path.c_str(), H5P_DEFAULT), H5Dclose};
  if (set.id < 0) file_->refuse("has no " + path);
  const Closer space{H5Dget_space(set.id), H5Sclose};
  std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.id)));
  if (!values.empty() && H5Dread(set.id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    file_->refuse(path + " cannot be read as numbers");
  return values;
}

std::vector<double> Hdf5Source::numbers(const std::string& path, std::size_t rows) const {
  auto values = numbers(path);
  if (values.size() != rows) file_->refuse(path + " is not as long as the columns beside it");
  return values;
}

std::vector<std::string> Hdf5Source::texts(const std::string& path) const {
  const Closer set{H5Dopen2(file_->id, path.c_str(), H5P_DEFAULT), H5Dclose};
  if (set.id < 0) file_->refuse("has no " + path);
  const Closer space{H5Dget_space(set.id), H5Sclose}, type{H5Dget_type(set.id), H5Tclose};
  std::vector<char*> pointers(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.id)));
  if (pointers.empty()) return {};
  if (H5Tis_variable_str(type.id) <= 0 || H5Dread(set.id, type.id, H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()) < 0)
    file_->refuse(path + " cannot be read as texts");
  std::vector<std::string> values;
  for (const char* pointer : pointers) values.push_back(pointer ? pointer : "");
  H5Dvlen_reclaim(type.id, space.id, H5P_DEFAULT, pointers.data());
  return values;
}

std::vector<std::string> Hdf5Source::texts(const std::string& path, std::size_t rows) const {
  auto values = texts(path);
  if (values.size() != rows) file_->refuse(path + " is not as long as the columns beside it");
  return values;
}

double Hdf5Source::number(const std::string& path) const {
  const auto values = numbers(path);
  if (values.size() != 1) file_->refuse(path + " is not a single number");
  return values[0];
}

std::vector<int> Hdf5Source::integers(const std::string& path) const {
  std::vector<int> out;
  for (double value : numbers(path)) out.push_back(static_cast<int>(value));
  return out;
}

std::vector<std::int64_t> Hdf5Source::long_integers(const std::string& path) const {
  const Closer set{H5Dopen2(file_->id, path.c_str(), H5P_DEFAULT), H5Dclose};
  if (set.id < 0) file_->refuse("has no " + path);
  const Closer space{H5Dget_space(set.id), H5Sclose};
  std::vector<std::int64_t> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.id)));
  if (!values.empty() && H5Dread(set.id, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    file_->refuse(path + " cannot be read as integers");
  return values;
}

double Hdf5Source::number(const std::string& path, std::string_view attribute) const {
  const Closer a{H5Aopen_by_name(file_->id, path.c_str(), std::string(attribute).c_str(), H5P_DEFAULT, H5P_DEFAULT),
                 H5Aclose};
  double value = 0;
  if (a.id < 0 || H5Aread(a.id, H5T_NATIVE_DOUBLE, &value) < 0)
    file_->refuse(path + " has no number \"" + std::string(attribute) + "\"");
  return value;
}

bool Hdf5Source::has(const std::string& path, std::string_view attribute) const {
  return H5Aexists_by_name(file_->id, path.c_str(), std::string(attribute).c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::string> Hdf5Source::attributes(const std::string& path) const {
  std::vector<std::string> names;
  const auto take = [](hid_t, const char* name, const H5A_info_t*, void* out) -> herr_t {
    static_cast<std::vector<std::string>*>(out)->push_back(name);
    return 0;
  };
  hsize_t at = 0;
  H5Aiterate_by_name(file_->id, path.c_str(), H5_INDEX_NAME, H5_ITER_INC, &at, take, &names, H5P_DEFAULT);
  return names;
}

std::int64_t Hdf5Source::integer(const std::string& path, std::string_view attribute) const {
  const Closer a{H5Aopen_by_name(file_->id, path.c_str(), std::string(attribute).c_str(), H5P_DEFAULT, H5P_DEFAULT),
                 H5Aclose};
  std::int64_t value = 0;
  if (a.id < 0 || H5Aread(a.id, H5T_NATIVE_INT64, &value) < 0)
    file_->refuse(path + " has no whole number \"" + std::string(attribute) + "\"");
  return value;
}

std::string Hdf5Source::text(const std::string& path, std::string_view attribute) const {
  const Closer a{H5Aopen_by_name(file_->id, path.c_str(), std::string(attribute).c_str(), H5P_DEFAULT, H5P_DEFAULT),
                 H5Aclose};
  const Closer type{a.id >= 0 ? H5Aget_type(a.id) : -1, H5Tclose};
  char* value = nullptr;
  if (a.id < 0 || H5Tis_variable_str(type.id) <= 0 || H5Aread(a.id, type.id, &value) < 0 || !value)
    file_->refuse(path + " has no text \"" + std::string(attribute) + "\"");
  std::string out = value;
  H5free_memory(value);
  return out;
}

}  // namespace beltlife
