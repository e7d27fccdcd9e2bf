// Whole files on disk: see whole_file.h.
#include "results/whole_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "results/results_file.h"
#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path, const std::string& what, const std::string& allowed) {
  throw BadInput({Problem{path.string(), 0, "", what, allowed}});
}

/// A file that is gone at the end of a scope unless it has been renamed.
struct Temporary {
  fs::path path;
  ~Temporary() {
    std::error_code ignored;
    if (!path.empty()) fs::remove(path, ignored);
  }
};

}  // namespace

void write_whole_file(const fs::path& path, const std::vector<char>& bytes) {
  check_writable(path);
  // In the same folder, so that the rename cannot cross file systems.
  Temporary temporary{path.parent_path() / fmt::format(".{}.{}.partial", path.filename().string(), getpid())};
  errno = 0;
  std::ofstream out(temporary.path, std::ios::binary | std::ios::trunc);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out)
    refuse(path, fmt::format("writing {} bytes failed: {}", bytes.size(), std::strerror(errno)),
           "free space on the disk, or a path elsewhere");
  std::error_code error;
  fs::rename(temporary.path, path, error);
  if (error) refuse(path, "cannot be put in place: " + error.message(), "a path at which a file may be replaced");
  temporary.path.clear();
}

}  // namespace beltlife
