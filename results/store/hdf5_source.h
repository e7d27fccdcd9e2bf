// Owns reading from an HDF5 file, without showing the HDF5 API to anybody.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace beltlife {

/// What stands at a path.
enum class Hdf5Kind { nothing, group, real, integer, truth, text };

/// An HDF5 file open for reading. Paths are absolute. Everything throws BadInput naming the file and what it lacks.
class Hdf5Source {
 public:
  explicit Hdf5Source(const std::string& file);
  ~Hdf5Source();
  Hdf5Source(const Hdf5Source&) = delete;
  Hdf5Source& operator=(const Hdf5Source&) = delete;

  /// The file's name, for refusals of what it says.
  const std::string& name() const;

  /// Names directly below a group, in the order in which they were written; none if there is no such group.
  std::vector<std::string> children(const std::string& path) const;
  Hdf5Kind kind(const std::string& path) const;
  /// Extents of a dataset; none if it has no dimension.
  std::vector<std::size_t> extents(const std::string& path) const;
  std::vector<double> numbers(const std::string& path) const;
  /// A column whose table has `rows` rows; refuses any other length.
  std::vector<double> numbers(const std::string& path, std::size_t rows) const;
  std::vector<std::string> texts(const std::string& path) const;
  std::vector<std::string> texts(const std::string& path, std::size_t rows) const;
  double number(const std::string& path) const;
  std::vector<int> integers(const std::string& path) const;
  /// Integers to the last digit, or yes and no as 1 and 0.
  std::vector<std::int64_t> long_integers(const std::string& path) const;
  double number(const std::string& path, std::string_view attribute) const;
  bool has(const std::string& path, std::string_view attribute) const;
  /// Names of the attributes of a group or dataset.
  std::vector<std::string> attributes(const std::string& path) const;
  std::int64_t integer(const std::string& path, std::string_view attribute) const;
  std::string text(const std::string& path, std::string_view attribute) const;

 private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace beltlife
