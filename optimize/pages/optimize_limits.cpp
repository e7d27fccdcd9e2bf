// What a layout search was asked, and what limits its answer: see optimize_parts.h.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "optimize/pages/optimize_parts.h"
#include "sim/eval/quantity_unit.h"
#include "sim/scene/scene_io.h"
#include "sim/scene/toml_tree.h"

namespace beltlife::optimize_page {

using nlohmann::json;

namespace {

const TomlNode* node_in(const TomlNode* node, std::string_view key) {
  const TomlTable* table = node ? node->table() : nullptr;
  const TomlEntry* entry = table ? table->find(key) : nullptr;
  return entry ? &entry->node : nullptr;
}
double number_at(const TomlNode* node, std::string_view key) {
  const TomlNode* at = node_in(node, key);
  if (!at) return none;
  if (const auto* whole = std::get_if<std::int64_t>(&at->value)) return static_cast<double>(*whole);
  const auto* number = std::get_if<double>(&at->value);
  return number ? *number : none;
}
std::string text_at(const TomlNode* node, std::string_view key) {
  const TomlNode* at = node_in(node, key);
  const auto* text = at ? std::get_if<std::string>(&at->value) : nullptr;
  return text ? *text : std::string();
}
const TomlArray& list_at(const TomlNode* node, std::string_view key) {
  static const TomlArray nothing;
  const TomlNode* at = node_in(node, key);
  return at && at->array() ? *at->array() : nothing;
}

/// The bound of a limit of the layout, by the name that the answer gives it; NaN where the file does not tell.
double bound_of_limit(const Asked& asked, const std::string& name, bool& upper) {
  struct Rule {
    const char *begins, *holds, *key;
    bool upper = false;
  };
  constexpr Rule rules[] = {{"pulleys ", " and ", "min_pulley_clearance_mm"},
                            {"wrap on ", "", "min_wrap_deg"},
                            {"span ", "", "min_span_mm"},
                            {"belt ", " and pulley ", "min_belt_clearance_mm"},
                            {"arm leverage", "", "min_arm_leverage_mm"},
                            {"shortest belt", "", "min_unstretched_length_mm"},
                            {"longest belt", "", "max_unstretched_length_mm", true},
                            {"travel ", "", "travel_deg"},
                            {"slip safety in ", "", "min_slip_safety"},
                            {"modes in ", "", "min_distance_percent"},
                            {"hub load in ", "", "max_hub_load_n", true}};
  const auto rule = std::find_if(std::begin(rules), std::end(rules), [&](const Rule& r) {
    return name.starts_with(r.begins) && name.find(r.holds) != name.npos;
  });
  if (rule == std::end(rules)) return none;
  upper = rule->upper;
  if (name.starts_with("wrap on "))
    if (const auto own = asked.wraps.find(name.substr(8)); own != asked.wraps.end()) return own->second;
  const auto at = asked.layout.find(rule->key);
  return at == asked.layout.end() ? none : at->second;
}

Row active_row(const json& answer, const Asked& asked, const json& a) {
  const std::string kind = text_in(a, "kind"), name = text_in(a, "name");
  const double left = number_in(a, "left");
  double bound = none;
  bool upper = false;
  if (kind == "limit") {
    bound = bound_of_limit(asked, name, upper);
  } else if (kind == "constraint") {
    for (const Constraint& c : asked.constraints) {
      if (c.name != name) continue;
      const double value = number_in(part_of(part_of(answer, "best"), "quantities"), c.quantity);
      const double from_lower = std::abs(c.bounds.lower + left - value),
                   from_upper = std::abs(c.bounds.upper - left - value);
      upper = std::isnan(c.bounds.lower) || from_upper < from_lower;
      bound = upper ? c.bounds.upper : c.bounds.lower;
    }
  } else if (const auto known = asked.parameters.find(name); known != asked.parameters.end()) {
    upper = kind == "upper bound";
    bound = upper ? known->second.upper : known->second.lower;
  }
  return {kind,
          name,
          number_text(upper ? bound - left : bound + left),
          std::isnan(bound) ? std::string("-") : (upper ? "at most " : "at least ") + number_text(bound),
          digits_text(std::abs(left) < 1e-9 ? 0 : left, 2),
          text_in(a, "unit")};
}

}  // namespace

Asked asked_of(const StudyHead& head) {
  Asked asked;
  TomlNode root;
  try {
    root = parse_toml(head.study_text, "study");
  } catch (const BadInput&) {
    return asked;  // bounds are left out of the page
  }
  const auto bounds = [](const TomlNode& n) { return Bounds{number_at(&n, "lower"), number_at(&n, "upper")}; };
  for (const TomlNode& p : list_at(&root, "parameter")) asked.parameters[text_at(&p, "path")] = bounds(p);
  for (const TomlNode& c : list_at(&root, "constraint")) {
    const std::string name = text_at(&c, "name"), quantity = text_at(&c, "quantity");
    asked.constraints.push_back({name.empty() ? quantity : name, quantity, bounds(c)});
  }
  const TomlNode* layout = node_in(&root, "layout");
  if (layout && layout->table())
    for (const TomlEntry& entry : layout->table()->entries)
      if (const double v = number_at(layout, entry.key); !std::isnan(v)) asked.layout[entry.key] = v;
  if (const double v = number_at(node_in(layout, "modes"), "min_distance_percent"); !std::isnan(v))
    asked.layout["min_distance_percent"] = v;
  for (const TomlNode& w : list_at(layout, "wrap")) asked.wraps[text_at(&w, "pulley")] = number_at(&w, "min_deg");
  return asked;
}

const json& found_of(const json& answer) {
  const json& best = part_of(answer, "best");
  return best.is_object() ? best : part_of(answer, "least_violating");
}

std::string number_text(double v, int digits) { return digits_text(v, digits); }

Section section_of(const char* id, const char* title, const char* heading, const std::string& html) {
  if (html.empty()) return {id, "", ""};
  return {id, title, fmt::format("<section id=\"{}\"><h2>{}</h2>\n{}</section>\n", id, heading, html)};
}

Section active_section(const json& answer, const Asked& asked) {
  std::vector<Row> rows, constraints;
  for (const json& a : rows_of(answer, "active")) rows.push_back(active_row(answer, asked, a));
  const auto value = [&](const json& design, const Constraint& c) {
    const double v = number_in(part_of(design, "quantities"), c.quantity);
    return Cell(number_text(v), v < c.bounds.lower || v > c.bounds.upper);
  };
  for (const Constraint& c : asked.constraints)
    constraints.push_back({c.name, value(part_of(answer, "start"), c), value(found_of(answer), c),
                           std::isnan(c.bounds.lower) ? "" : number_text(c.bounds.lower),
                           std::isnan(c.bounds.upper) ? "" : number_text(c.bounds.upper), unit_of_name(c.quantity)});
  std::string html, broken;
  if (!rows.empty())
    html +=
        "<p>What the best layout comes near to: distances within 1 mm, angles within 1 degree, constraints and "
        "loads within 5 % of their bound, parameters within 1 % of the way between theirs.</p>\n" +
        html_table("study-active", {"kind", "name", "value", "bound", "left", "unit"}, rows);
  else if (part_of(answer, "active").is_array())
    html += "<p>The best layout comes near to no limit and no bound.</p>\n";
  if (!constraints.empty())
    html += "<h3>Constraints</h3>\n" +
            html_table("study-constraints",
                       {"constraint", "start", part_of(answer, "best").is_object() ? "best" : "breaks least",
                        "at least", "at most", "unit"},
                       constraints);
  const std::array<std::pair<const char*, const json*>, 2> designs{
      {{"Start", &part_of(answer, "start")}, {"Breaks least", &part_of(answer, "least_violating")}}};
  for (const auto& [which, design] : designs)
    for (const std::string& words : texts_in(*design, "violated"))
      broken += fmt::format("<li>{}: {}</li>\n", which, html_escaped(words));
  if (!broken.empty()) html += "<h3>Broken limits</h3>\n<ul>\n" + broken + "</ul>\n";
  return section_of("active", "Limits", "What limits it", html);
}

}  // namespace beltlife::optimize_page
