// Owns what a report page is about: the drive, its evaluated ranges and life, worked out again from a result file.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "results/store/result_reader.h"
#include "sim/eval/summary.h"
#include "sim/life/life.h"

namespace beltlife {

struct Subject {
  ResultFile file;
  Model model;
  struct Range {
    const RunRecord* run;
    const WindowRecord* window;
    RangeSummary summary;
    std::string id;  ///< of its section
  };
  std::vector<Range> ranges;
  std::optional<Life> life;
  Subject() = default;
  Subject(const Subject&) = delete;  // ranges point into file
  Subject& operator=(const Subject&) = delete;
  Subject(Subject&&) = default;
};

/// `name` is the file's, for messages. Throws BadInput if its scene cannot be read.
Subject subject_of(const ResultFile& file, const std::string& name);

/// The range and pulley that do most of the damage.
struct Governing {
  const RangeLife* range = nullptr;
  const PulleyLife* pulley = nullptr;
};
Governing governing(const Life& life);

/// The range that a page shows first: the one that does most of the damage, else the first; null if none was evaluated.
const Subject::Range* shown_range(const Subject& subject);

/// A channel's samples in the range's window; none if it was not recorded.
std::span<const double> in_window(const Subject::Range& range, const std::string& channel);
/// Time of each of them from the start of the window, s.
std::vector<double> window_time(const Subject::Range& range);

/// How a drive is drawn.
struct DrawnState {
  std::vector<double> tension;  ///< N, mean, one a span
  double arm = 0;               ///< rad, mean
};
/// In a range; at rest if it is null.
DrawnState drawn_state(const Subject& subject, const Subject::Range* range);

/// Of what the life is: of the duty cycle only if the file holds all its ranges.
std::string life_over(const Subject& subject);

/// In words, whatever a reader should know before believing the page.
std::vector<std::string> warnings(const Subject& subject);

/// Turning in a belt that could not hold the torque.
bool slips(const QuasiStaticPulley& pulley);

}  // namespace beltlife
