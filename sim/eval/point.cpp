// The request to stop: see point.h.
#include "sim/eval/point.h"

#include <atomic>

namespace beltlife {
namespace {
std::atomic<bool> stop = false;  // a signal has nowhere else to leave word
}

void request_stop() { stop = true; }
bool stop_requested() { return stop; }

}  // namespace beltlife
