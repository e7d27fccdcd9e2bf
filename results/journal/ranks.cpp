// What is the same with and without MPI, and the build without it: see ranks.h.
#include "results/journal/ranks.h"

#include <algorithm>
#include <cstdlib>

#include "sim/lanes/lane_belt.h"
#include "sim/scene/scene_io.h"

namespace beltlife {

std::size_t chunk_size(std::size_t points, int processes, int threads) {
  const std::size_t share = (points + processes - 1) / static_cast<std::size_t>(processes);
  return std::clamp(share, std::size_t{1}, static_cast<std::size_t>(std::max(1, threads)) * lanes);
}

#ifndef BELTLIFE_MPI
std::unique_ptr<Ranks> Ranks::join() {
  const char* size = nullptr;
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (!size) size = std::getenv(name);
  if (size && std::atoi(size) > 1)
    throw BadInput({Problem{"mpirun", 0, "-n " + std::string(size), "this program was built without MPI",
                            "one process; or a build with -DBELTLIFE_MPI=ON (apt-get install libopenmpi-dev)"}});
  return nullptr;
}
#endif

}  // namespace beltlife
