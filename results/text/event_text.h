// Owns the words and numbers of an event: tables for people and pages, JSON for machines.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sim/eval/event.h"

namespace beltlife {

/// A table without its looks: those of a terminal and of a page differ.
struct EventTable {
  std::string id;  ///< "spans", ...
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

/// Spans, pulleys, and what else has a load: output, shafts, gears, arm. Tables without rows are left out.
std::vector<EventTable> event_tables(const EventSummary& summary);
/// How long, how fast, how complete, in a sentence.
std::string event_sentence(const EventSummary& summary);

std::string text_of(const EventSummary& summary);
nlohmann::json json_of(const EventSummary& summary);

}  // namespace beltlife
