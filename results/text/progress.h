// Owns progress with ETA on standard error.
#pragma once

#include <chrono>
#include <string>

namespace beltlife {

/// "baseline: 12.0 of 24.0 s simulated, 3:05 left". On a terminal the line is rewritten; elsewhere a line every ten
/// seconds.
class Progress {
 public:
  Progress(std::string what, double total, std::string unit, bool quiet, int digits = 1);
  ~Progress();
  void operator()(double done);

 private:
  std::string what_, unit_;
  double total_;
  int digits_;
  bool quiet_, terminal_, shown_ = false;
  std::chrono::steady_clock::time_point start_, last_;
};

}  // namespace beltlife
