// Owns what `check` prints of the statics of a drive: quasi-static ranges, take-up, estimated life.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "sim/model.h"

namespace beltlife {

/// Tables for people: tensions, hub loads and slip safety by range, take-up, estimated life; empty where the scene has
/// none of them.
std::string statics_text(const Model& model);

/// Adds "quasi_static" {RANGE: {...}} and "take_up" [...] to the answer of `check`.
void add_statics(const Model& model, nlohmann::json& answer);

}  // namespace beltlife
