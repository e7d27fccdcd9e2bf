// Progress with ETA: see progress.h.
#include "results/text/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

namespace beltlife {

Progress::Progress(std::string what, double total, std::string unit, bool quiet, int digits)
    : what_(std::move(what)),
      unit_(std::move(unit)),
      total_(total),
      digits_(digits),
      quiet_(quiet),
      terminal_(isatty(2)) {
  start_ = last_ = std::chrono::steady_clock::now();
}

Progress::~Progress() {
  if (shown_ && terminal_) fmt::print(stderr, "\r\033[K");
}

void Progress::operator()(double done) {
  if (quiet_ || done <= 0) return;
  const auto now = std::chrono::steady_clock::now();
  if (std::chrono::duration<double>(now - last_).count() < (terminal_ ? 0.2 : 10.0)) return;
  last_ = now;
  shown_ = true;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const int left = static_cast<int>(std::lround(elapsed * (total_ - done) / done));
  fmt::print(stderr, "{}{}: {:.{}f} of {:.{}f} {}, {}:{:02} left{}", terminal_ ? "\r\033[K" : "", what_, done, digits_,
             total_, digits_, unit_, left / 60, left % 60, terminal_ ? "" : "\n");
  std::fflush(stderr);
}

}  // namespace beltlife
