// Owns the models of a drive's operating ranges: one for every condition among them.
#pragma once

#include <vector>

#include "sim/model.h"

namespace beltlife {

/// Ranges of one condition share a model, and those of the given model's condition take that one: a drive whose ranges
/// differ in speed alone costs nothing more. May be shared between threads.
class RangeModels {
 public:
  /// `model` is kept by reference.
  explicit RangeModels(const Model& model);
  explicit RangeModels(Model&&) = delete;

  /// The drive in the condition of one of its ranges, or in the base condition. Throws std::logic_error for any other.
  const Model& of(const DriveCondition& condition) const;

 private:
  const Model& given_;
  std::vector<Model> others_;
};

}  // namespace beltlife
