// Owns how a run can end: a value, never an exception.
#pragma once

#include <string>

namespace beltlife {

enum class RunState { ok, diverged, off_pulley };

struct RunStatus {
  RunState state = RunState::ok;
  double time_s = 0;   ///< simulated time of the failure
  int element = -1;    ///< belt element or node where it showed, -1 if it is not the belt
  std::string where;   ///< place in words: "span drive-idler_2", "pulley crank"
  std::string cause;   ///< likely cause
  std::string advice;  ///< what to try

  bool ok() const { return state == RunState::ok; }
};

inline const char* to_string(RunState state) {
  constexpr const char* names[] = {"ok", "diverged", "off_pulley"};
  return names[static_cast<int>(state)];
}

}  // namespace beltlife
