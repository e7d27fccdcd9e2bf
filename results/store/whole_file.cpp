// Whole files on disk: see whole_file.h.
#include "results/store/whole_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path, const std::string& what, const std::string& allowed) {
  throw BadInput({Problem{.file = path.string(), .line = 0, .key = "", .what = what, .allowed = allowed}});
}

/// Where the bytes go until they are whole: in the same folder, so that the rename cannot cross file systems.
fs::path temporary_beside(const fs::path& path) {
  return path.parent_path() / fmt::format(".{}.{}.partial", path.filename().string(), getpid());
}

/// Removes the temporary unless it became the result.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& target) : path_(temporary_beside(target)) {}
  ~TemporaryFile() {
    std::error_code ignored;
    if (!kept_) fs::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const fs::path& path() const { return path_; }
  void rename_to(const fs::path& target, std::error_code& error) {
    fs::rename(path_, target, error);
    kept_ = !error;
  }

 private:
  fs::path path_;
  bool kept_ = false;
};

void refuse_obvious(const fs::path& path) {
  if (path.filename().empty()) refuse(path, "names no file", "a file name, for instance result.h5");
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::is_directory(status)) refuse(path, "is a directory", "a file name inside it");
  if (fs::exists(status) && !fs::is_regular_file(status))
    refuse(path, "exists and is not a regular file", "the name of a new file or of one to replace");
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::exists(folder, ignored))
    refuse(path, fmt::format("there is no folder {}", folder.string()), "an existing folder; create it first");
  if (!fs::is_directory(folder, ignored))
    refuse(path, fmt::format("{} is not a folder", folder.string()), "a file in an existing folder");
}

void write_bytes(const fs::path& path, const fs::path& temporary, std::span<const char> bytes) {
  errno = 0;
  std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
  if (!out)
    refuse(path, fmt::format("no file can be created in this folder: {}", std::strerror(errno)),
           "a folder in which you may write");
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out)
    refuse(path, fmt::format("writing {} bytes failed: {}", bytes.size(), std::strerror(errno)),
           "free space on the disk, or a path elsewhere");
}

}  // namespace

void check_writable(const fs::path& path) {
  refuse_obvious(path);
  const TemporaryFile probe(path);  // the only test that holds for every kind of user and file system
  write_bytes(path, probe.path(), {});
}

void write_whole_file(const fs::path& path, std::span<const char> bytes) {
  refuse_obvious(path);
  TemporaryFile temporary(path);
  write_bytes(path, temporary.path(), bytes);
  std::error_code error;
  temporary.rename_to(path, error);
  if (error) refuse(path, "cannot be put in place: " + error.message(), "a path at which a file may be replaced");
}

}  // namespace beltlife
