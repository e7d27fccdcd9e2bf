// Owns an HDF5 file that is built in memory, without showing the HDF5 API to anybody.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace beltlife {

/// What the HDF5 library itself complained of, in its innermost words.
struct Hdf5Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A file in memory: putting the bytes on disk is the caller's business, so that a full disk is met by plain file
/// output and not by HDF5 halfway through closing. Paths are absolute ("/runs/0"); parents come before children.
/// Everything throws Hdf5Error.
class Hdf5Image {
 public:
  Hdf5Image();
  ~Hdf5Image();
  Hdf5Image(const Hdf5Image&) = delete;
  Hdf5Image& operator=(const Hdf5Image&) = delete;

  void group(const std::string& path, std::string_view description);

  /// One-dimensional, little-endian 64-bit floats or 32-bit integers or variable-length UTF-8 strings; long ones are
  /// chunked and compressed (shuffle, deflate).
  void dataset(const std::string& path, std::span<const double> values, std::string_view unit, std::string_view about);
  void dataset(const std::string& path, std::span<const int> values, std::string_view unit, std::string_view about);
  void dataset(const std::string& path, std::span<const std::string> values, std::string_view about);
  void dataset(const std::string& path, std::span<const std::int64_t> values, std::string_view unit,
               std::string_view about);
  /// Yes and no as h5py writes and reads booleans: an enumeration of FALSE and TRUE; likewise truth() without
  /// dimension.
  void truths(const std::string& path, std::span<const std::int8_t> values, std::string_view about);
  /// Rows of `columns` values each, one row after the other; `columns` is positive.
  void matrix(const std::string& path, std::span<const double> values, std::size_t columns, std::string_view unit,
              std::string_view about);
  /// A dataset without dimension.
  void scalar(const std::string& path, double value, std::string_view unit, std::string_view about);
  void scalar(const std::string& path, std::int64_t value, std::string_view unit, std::string_view about);
  void scalar(const std::string& path, const std::string& value, std::string_view about);
  void truth(const std::string& path, bool value, std::string_view about);

  void attribute(const std::string& path, std::string_view name, double value);
  void attribute(const std::string& path, std::string_view name, std::int64_t value);
  void attribute(const std::string& path, std::string_view name, std::string_view value);
  void attribute(const std::string& path, std::string_view name, std::span<const std::string> values);

  /// The file as it belongs on disk.
  std::vector<char> bytes() const;

 private:
  void describe(const std::string& path, std::string_view unit, std::string_view about);

  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace beltlife
