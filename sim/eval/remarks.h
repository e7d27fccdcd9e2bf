// Owns what is to be said of a drive before it runs.
#pragma once

#include <string>

#include "sim/model.h"

namespace beltlife {

/// What is to be said of a mesh with elements longer than a fifth of a pulley's radius, which touch it with one or two
/// nodes at a time; else empty.
std::string coarse_mesh(const Model& model);

}  // namespace beltlife
