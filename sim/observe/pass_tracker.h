// Owns the following of belt nodes through their passes over pulleys: the largest contact forces of each.
#pragma once

#include <vector>

#include "sim/model.h"
#include "sim/record.h"
#include "sim/state.h"

namespace beltlife {

/// A pass lasts from the contact search that first finds a node near a pulley to the one that no longer does, so a
/// node that bounces at entry is still on one pass. Only passes that begin and end while the tracker is open count.
class PassTracker {
 public:
  PassTracker(const Model& model, double window_s);

  /// Opens at the state's present; passes under way do not count.
  void open(const State& state);
  /// After a contact search: ends the passes of nodes that moved on.
  void searched(const State& state);
  /// Takes the contact forces of now into the maxima; `sample` also into the sampled ones. Returns the largest normal
  /// force, N.
  double observe(const State& state, const Work& work, bool sample);

  std::vector<PassForces> take() { return std::move(passes_); }

 private:
  void finish(int node);

  std::vector<PassForces> passes_;
  std::vector<int> near_;      // pulley of each node's pass under way
  std::vector<char> counts_;   // whether it began while open
  std::vector<char> sampled_;  // whether a sample caught it in contact
  NodeArray normal_, tangential_, sampled_normal_, sampled_tangential_;
};

}  // namespace beltlife
