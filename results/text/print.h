// Owns what the commands print: tables for people, JSON for machines.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "sim/eval/summary.h"
#include "sim/life/life.h"
#include "sim/model.h"
#include "sim/record.h"
#include "sim/schemes/scheme.h"

namespace beltlife {

nlohmann::json json_of(const RangeSummary& summary);
nlohmann::json json_of(const Life& life);
nlohmann::json json_of(const RangeLoad& load);
nlohmann::json json_of(const RunStatus& status);

std::string text_of(const RangeSummary& summary);
/// Mean powers by Energy as a table, those that are zero left out, and what of the throughput is not accounted for.
std::string power_text(const std::vector<double>& power_w, double residual);
nlohmann::json json_of_powers(const std::vector<double>& power_w);
/// How a range that may end early did end, in words; empty of one that may not, or that failed.
std::string settling_text(const RunRecord& run, const ProfileSpec& profile);
/// `over` says of what: "the duty cycle", "range B100 alone".
std::string text_of(const Life& life, const std::string& over);
/// A number by a format; "no end" where it is infinite, "-" where there is none.
std::string number_text(double value, const char* format);
/// What the torque tables and the driver put in, and what bending the belt costs beside it, per range.
std::string loss_table(const std::vector<RangeSummary>& ranges);
std::string text_of(const RunStatus& status);
std::string text_of(const std::vector<KernelTime>& times, int nodes);

/// A number or null where it is not finite (JSON has no infinity).
nlohmann::json finite(double value);

/// An answer as text. A path may hold bytes that are no UTF-8; JSON cannot, and shows a replacement character.
std::string json_text(const nlohmann::json& answer);

}  // namespace beltlife
