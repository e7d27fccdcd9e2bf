// Owns the named numbers of a drive: what studies vary against, calibrations fit and searches improve.
#pragma once

#include <string>
#include <vector>

#include "sim/eval/summary.h"
#include "sim/life/life.h"

namespace beltlife {

/// A named number, "B100.drive_shaft.speed_rpm.order_3"; units stand in the names.
struct Quantity {
  std::string name;
  double value = 0;
};

/// Every quantity of a summary, in a fixed order that depends on the scene alone.
std::vector<Quantity> quantities_of(const RangeSummary& summary);

/// Forces per pass, equivalent stresses and life of a range, likewise.
std::vector<Quantity> quantities_of(const RangeLoad& load, const RangeLife& life);

/// Over all ranges: life, largest hub load, highest and lowest span tension, largest slip (absolute).
std::vector<Quantity> duty_quantities(const std::vector<RangeSummary>& ranges, const Life& life);

/// Names of all quantities of a scene: those of every range, then those over all of them.
std::vector<std::string> quantity_names(const Model& model);

}  // namespace beltlife
