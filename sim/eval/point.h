// Owns a point of a study and what came of evaluating it: the language between drivers, journals and models.
#pragma once

#include <array>
#include <cstddef>
#include <exception>
#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace beltlife {

/// One parameter's value; text for choices such as a scheme or a belt side.
using Setting = std::variant<double, std::string>;
/// Values of a study's parameters, in the study's order.
using Point = std::vector<Setting>;

enum class PointState { ok, infeasible, diverged, timed_out, failed };
inline constexpr std::array<std::string_view, 5> point_state_names{"ok", "infeasible", "diverged", "timed_out",
                                                                   "failed"};
constexpr std::string_view to_string(PointState state) { return point_state_names[static_cast<std::size_t>(state)]; }

/// What came of a point. Drivers never see a NaN or an infinity: a point that gave one has failed.
struct Answer {
  PointState state = PointState::failed;
  std::string reason;          ///< in words, unless ok
  std::vector<double> values;  ///< one a quantity asked for, all finite; empty unless ok
  double processor_s = 0;      ///< what it cost; the only part that differs from run to run

  bool ok() const { return state == PointState::ok; }
};

/// Gets a point's index in its batch and its answer as soon as that is whole: from any thread, one at a time.
using OnAnswer = std::function<void(std::size_t, const Answer&)>;

/// Whatever answers a batch of points: the belt simulator, another program, a function of a test. Answers depend on
/// the point alone, not on its batch. Throws Interrupted after a request to stop.
using PointModel = std::function<std::vector<Answer>(const std::vector<Point>&, const OnAnswer&)>;

/// A request to stop was met before a batch was whole; the answers that were there have been handed on.
struct Interrupted : std::exception {
  const char* what() const noexcept override { return "stopped on request"; }
};

/// Asks all batches of this process to end after what is running (of a signal handler: async-signal-safe).
void request_stop();
bool stop_requested();

/// A point from numbers alone, the usual case, and back.
inline Point point_of(const std::vector<double>& numbers) { return {numbers.begin(), numbers.end()}; }
inline double number_of(const Setting& setting) { return std::get<double>(setting); }

}  // namespace beltlife
