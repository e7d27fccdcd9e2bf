// Owns the writing of HDF5 files; reading them is hdf5_source.cpp.
#include "results/store/hdf5_image.h"

#include <hdf5.h>

#include <algorithm>

namespace beltlife {

namespace {

herr_t keep_innermost(unsigned, const H5E_error2_t* error, void* reason) {
  if (error->desc && *error->desc) *static_cast<std::string*>(reason) = error->desc;
  return 0;
}

[[noreturn]] void fail(const std::string& doing) {
  std::string reason = "no reason given";
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, keep_innermost, &reason);
  throw Hdf5Error(doing + ": " + reason);
}

void check(herr_t outcome, const std::string& doing) {
  if (outcome < 0) fail(doing);
}

/// An HDF5 identifier that closes itself.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t), const std::string& doing) : id_(id), close_(close) {
    if (id < 0) fail(doing);
  }
  ~Handle() { close_(id_); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// Keeps the library from printing its error stack while an image exists; the reasons travel in Hdf5Error.
class Silence {
 public:
  Silence() {
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Silence() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

hid_t create_in_memory() {
  constexpr std::size_t growth = std::size_t{1} << 20;
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "preparing the file");
  check(H5Pset_fapl_core(access, growth, false), "preparing the file");
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "preparing the file");
  check(H5Pset_link_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED), "preparing the file");
  return H5Fcreate("in memory", H5F_ACC_EXCL, creation, access);
}

Handle utf8_string_type() {
  const char* doing = "making the string type";
  const hid_t type = H5Tcopy(H5T_C_S1);
  if (type >= 0) {
    check(H5Tset_size(type, H5T_VARIABLE), doing);
    check(H5Tset_cset(type, H5T_CSET_UTF8), doing);
  }
  return Handle(type, H5Tclose, doing);
}

std::vector<const char*> c_strings(std::span<const std::string> values) {
  std::vector<const char*> pointers;
  for (const std::string& value : values) pointers.push_back(value.c_str());
  return pointers;
}

Handle line_of(std::size_t count) {
  const hsize_t extent = count;
  return Handle(H5Screate_simple(1, &extent, nullptr), H5Sclose, "making a dataspace");
}

void write_attribute(hid_t file, const std::string& path, std::string_view name, hid_t file_type, hid_t memory_type,
                     hid_t space, const void* value) {
  const std::string doing = "writing attribute " + std::string(name) + " of " + path;
  const Handle attribute(H5Acreate_by_name(file, path.c_str(), std::string(name).c_str(), file_type, space, H5P_DEFAULT,
                                           H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose, doing);
  if (value != nullptr) check(H5Awrite(attribute, memory_type, value), doing);  // a list may be empty
}

/// Without `extents` the dataset has no dimension.
void write_dataset(hid_t file, const std::string& path, hid_t file_type, hid_t memory_type, const void* values,
                   std::span<const hsize_t> extents, bool compress) {
  const std::string doing = "writing " + path;
  const auto rank = static_cast<int>(extents.size());
  const Handle space(rank == 0 ? H5Screate(H5S_SCALAR) : H5Screate_simple(rank, extents.data(), nullptr), H5Sclose,
                     "making a dataspace");
  hsize_t count = 1;
  for (const hsize_t extent : extents) count *= extent;
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, doing);
  check(H5Pset_obj_track_times(creation, false), doing);  // same input, same bytes
  constexpr hsize_t worth_compressing = 64, largest_chunk = 8192;
  if (compress && count >= worth_compressing) {
    std::vector<hsize_t> chunk(extents.begin(), extents.end());
    for (hsize_t& side : chunk) side = std::min(side, rank == 1 ? largest_chunk : hsize_t{128});
    check(H5Pset_chunk(creation, rank, chunk.data()), doing);
    check(H5Pset_shuffle(creation), doing);
    check(H5Pset_deflate(creation, 4), doing);
  }
  const Handle dataset(H5Dcreate2(file, path.c_str(), file_type, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose,
                       doing);
  if (count > 0) check(H5Dwrite(dataset, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), doing);
}

Handle truth_type() {
  const char* doing = "making the type of yes and no";
  const hid_t type = H5Tenum_create(H5T_STD_I8LE);
  const std::int8_t no = 0, yes = 1;
  if (type >= 0) {
    check(H5Tenum_insert(type, "FALSE", &no), doing);
    check(H5Tenum_insert(type, "TRUE", &yes), doing);
  }
  return Handle(type, H5Tclose, doing);
}

}  // namespace

struct Hdf5Image::File {
  Silence silence;
  Handle id{create_in_memory(), H5Fclose, "creating the file"};
};

Hdf5Image::Hdf5Image() : file_(std::make_unique<File>()) {}
Hdf5Image::~Hdf5Image() = default;

void Hdf5Image::group(const std::string& path, std::string_view description) {
  const std::string doing = "making group " + path;
  {
    const Handle creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, doing);
    check(H5Pset_link_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED), doing);
    const Handle made(H5Gcreate2(file_->id, path.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT), H5Gclose, doing);
  }
  attribute(path, "description", description);
}

void Hdf5Image::describe(const std::string& path, std::string_view unit, std::string_view about) {
  attribute(path, "unit", unit);
  attribute(path, "description", about);
}

void Hdf5Image::dataset(const std::string& path, std::span<const double> values, std::string_view unit,
                        std::string_view about) {
  const hsize_t extent[] = {values.size()};
  write_dataset(file_->id, path, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values.data(), extent, true);
  describe(path, unit, about);
}

void Hdf5Image::dataset(const std::string& path, std::span<const int> values, std::string_view unit,
                        std::string_view about) {
  const hsize_t extent[] = {values.size()};
  write_dataset(file_->id, path, H5T_STD_I32LE, H5T_NATIVE_INT, values.data(), extent, true);
  describe(path, unit, about);
}

void Hdf5Image::dataset(const std::string& path, std::span<const std::int64_t> values, std::string_view unit,
                        std::string_view about) {
  const hsize_t extent[] = {values.size()};
  write_dataset(file_->id, path, H5T_STD_I64LE, H5T_NATIVE_INT64, values.data(), extent, true);
  describe(path, unit, about);
}

void Hdf5Image::dataset(const std::string& path, std::span<const std::string> values, std::string_view about) {
  const Handle type = utf8_string_type();
  const hsize_t extent[] = {values.size()};
  write_dataset(file_->id, path, type, type, c_strings(values).data(), extent, false);
  describe(path, "", about);
}

void Hdf5Image::truths(const std::string& path, std::span<const std::int8_t> values, std::string_view about) {
  const Handle type = truth_type();
  const hsize_t extent[] = {values.size()};
  write_dataset(file_->id, path, type, type, values.data(), extent, false);
  describe(path, "", about);
}

void Hdf5Image::matrix(const std::string& path, std::span<const double> values, std::size_t columns,
                       std::string_view unit, std::string_view about) {
  const hsize_t extents[] = {values.size() / columns, columns};
  write_dataset(file_->id, path, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values.data(), extents, true);
  describe(path, unit, about);
}

void Hdf5Image::scalar(const std::string& path, double value, std::string_view unit, std::string_view about) {
  write_dataset(file_->id, path, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value, {}, false);
  describe(path, unit, about);
}

void Hdf5Image::scalar(const std::string& path, std::int64_t value, std::string_view unit, std::string_view about) {
  write_dataset(file_->id, path, H5T_STD_I64LE, H5T_NATIVE_INT64, &value, {}, false);
  describe(path, unit, about);
}

void Hdf5Image::scalar(const std::string& path, const std::string& value, std::string_view about) {
  const Handle type = utf8_string_type();
  const char* pointer = value.c_str();
  write_dataset(file_->id, path, type, type, &pointer, {}, false);
  describe(path, "", about);
}

void Hdf5Image::truth(const std::string& path, bool value, std::string_view about) {
  const Handle type = truth_type();
  const std::int8_t byte = value;
  write_dataset(file_->id, path, type, type, &byte, {}, false);
  describe(path, "", about);
}

void Hdf5Image::attribute(const std::string& path, std::string_view name, double value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "making a dataspace");
  write_attribute(file_->id, path, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, space, &value);
}

void Hdf5Image::attribute(const std::string& path, std::string_view name, std::int64_t value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "making a dataspace");
  write_attribute(file_->id, path, name, H5T_STD_I64LE, H5T_NATIVE_INT64, space, &value);
}

void Hdf5Image::attribute(const std::string& path, std::string_view name, std::string_view value) {
  const std::string text(value);
  const char* pointer = text.c_str();
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "making a dataspace");
  const Handle type = utf8_string_type();
  write_attribute(file_->id, path, name, type, type, space, &pointer);
}

void Hdf5Image::attribute(const std::string& path, std::string_view name, std::span<const std::string> values) {
  const Handle type = utf8_string_type();
  const Handle space = line_of(values.size());
  write_attribute(file_->id, path, name, type, type, space, c_strings(values).data());
}

std::vector<char> Hdf5Image::bytes() const {
  check(H5Fflush(file_->id, H5F_SCOPE_GLOBAL), "finishing the file");
  const ssize_t size = H5Fget_file_image(file_->id, nullptr, 0);
  if (size < 0) fail("finishing the file");
  std::vector<char> image(static_cast<std::size_t>(size));
  if (H5Fget_file_image(file_->id, image.data(), image.size()) != size) fail("finishing the file");
  return image;
}

}  // namespace beltlife
