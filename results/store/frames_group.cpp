// Frames of the moving drive in a file: see frames_group.h.
#include "results/store/frames_group.h"

#include <array>
#include <utility>

#include "results/store/file_paths.h"
#include "results/store/names.h"
#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

// A drive without pulleys has no matrices about them.
using Matrix = std::pair<const names::Dataset*, std::vector<double> Frames::*>;
constexpr std::array<Matrix, 3> by_node{
    {{&names::frame_x, &Frames::x_m}, {&names::frame_y, &Frames::y_m}, {&names::frame_tension, &Frames::tension_n}}};
constexpr std::array<Matrix, 3> by_pulley{{{&names::frame_angle, &Frames::pulley_angle_rad},
                                           {&names::frame_centre_x, &Frames::pulley_x_m},
                                           {&names::frame_centre_y, &Frames::pulley_y_m}}};

void put_matrices(Hdf5Image& file, const std::string& at, const Frames& frames, const std::array<Matrix, 3>& matrices) {
  for (const auto& [as, member] : matrices) {
    const std::vector<double>& values = frames.*member;
    if (!values.empty())
      file.matrix(join(at, as->name), values, values.size() / frames.time_s.size(), as->unit, as->about);
  }
}

void read_matrices(const Hdf5Source& file, const std::string& at, Frames& frames,
                   const std::array<Matrix, 3>& matrices) {
  if (file.kind(join(at, matrices.front().first->name)) == Hdf5Kind::nothing) return;
  std::size_t columns = 0;
  for (const auto& [as, member] : matrices) {
    const std::string path = join(at, as->name);
    const std::vector<std::size_t> sides = file.extents(path);
    if (columns == 0 && sides.size() == 2) columns = sides[1];
    if (sides != std::vector{frames.time_s.size(), columns})
      throw BadInput({Problem{file.name(), 0, path, "does not belong to the frames beside it", "a whole result file"}});
    frames.*member = file.numbers(path);
  }
}

}  // namespace

void put_frames(Hdf5Image& file, const std::string& at, const Frames& frames) {
  if (frames.time_s.empty()) return;
  file.group(at,
             "the moving drive at the end of the window; rows of every matrix belong to time_s, columns to belt nodes "
             "or pulleys in scene order");
  file.dataset(join(at, names::time.name), frames.time_s, names::time.unit, names::time.about);
  put_matrices(file, at, frames, by_node);
  put_matrices(file, at, frames, by_pulley);
}

Frames read_frames(const Hdf5Source& file, const std::string& at) {
  Frames frames;
  if (file.kind(at) != Hdf5Kind::group) return frames;
  frames.time_s = file.numbers(join(at, names::time.name));
  read_matrices(file, at, frames, by_node);
  read_matrices(file, at, frames, by_pulley);
  return frames;
}

}  // namespace beltlife
