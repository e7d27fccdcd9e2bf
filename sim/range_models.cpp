// One model for every condition: see range_models.h.
#include "sim/range_models.h"

#include <algorithm>
#include <stdexcept>

namespace beltlife {
namespace {

// What is reduced and reported of a drive relies on this: names, counts and belt length are read off any of its models.
void require_same_drive(const Model& a, const Model& b) {
  if (a.body_name != b.body_name || a.pulleys != b.pulleys || a.belt.nodes != b.belt.nodes ||
      a.belt.unstretched_length != b.belt.unstretched_length)
    throw std::logic_error("a condition has made another drive");
}

}  // namespace

RangeModels::RangeModels(const Model& model) : given_(model) {
  const auto add = [&](const DriveCondition& condition) {
    const auto known = [&](const Model& m) { return m.condition == condition; };
    if (known(given_) || std::any_of(others_.begin(), others_.end(), known)) return;
    others_.push_back(in_condition(given_, condition));
    require_same_drive(given_, others_.back());
  };
  add({});
  for (const RangeSpec& range : given_.scene.range) add(range.condition);
}

const Model& RangeModels::of(const DriveCondition& condition) const {
  if (given_.condition == condition) return given_;
  for (const Model& m : others_)
    if (m.condition == condition) return m;
  throw std::logic_error("no range of the drive has this condition");
}

}  // namespace beltlife
