// Owns the map of a sweep, amplitude by frequency and crank speed with natural frequencies on it, as a gnuplot script.
#pragma once

#include <string>

#include "sim/eval/sweep.h"

namespace beltlife {

/// Colours are logarithmic over three decades below the largest amplitude, with rays of whole orders and lines of
/// natural frequencies. The sweep has places and the channel an amplitude above 0.
std::string sweep_map_script(const Sweep& sweep, const SweepChannel& channel);

}  // namespace beltlife
