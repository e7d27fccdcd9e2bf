// What a layout search was asked, and what limits its answer: see optimize_parts.h.
#include <fmt/format.h>

#include <cmath>

#include "optimize/pages/optimize_parts.h"
#include "sim/eval/quantity_unit.h"
#include "sim/scene/scene_io.h"
#include "sim/scene/toml_tree.h"

namespace beltlife::optimize_page {

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

Row active_row(const ActiveLimit& a) {
  const bool known = std::isfinite(a.bound);
  const std::string missing = "not in this log";  // of a version that recorded the distance alone
  return {a.kind,
          a.name,
          known ? number_text(a.value) : missing,
          known ? (a.at_most ? "at most " : "at least ") + number_text(a.bound) : missing,
          digits_text(std::abs(a.left) < 1e-9 ? 0 : a.left, 2),
          a.unit};
}

/// A design's value of what a constraint bounds.
Cell constraint_cell(const DesignAnswer* design, const Constraint& c) {
  if (!design || !design->quantities.value) return "did not run";
  const auto at = design->quantities.value->find(c.quantity);
  if (at == design->quantities.value->end()) return "not recorded";
  return {number_text(at->second), at->second < c.bounds.lower || at->second > c.bounds.upper};
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
  return asked;
}

const DesignAnswer* found_of(const SearchAnswer& answer) {
  if (answer.best) return &*answer.best;
  return answer.least_violating ? &*answer.least_violating : nullptr;
}

std::string number_text(double v, int digits) { return digits_text(v, digits); }

Section section_of(const char* id, const char* title, const char* heading, const std::string& html) {
  if (html.empty()) return {id, "", ""};
  return {id, title, fmt::format("<section id=\"{}\"><h2>{}</h2>\n{}</section>\n", id, heading, html)};
}

Section active_section(const SearchAnswer& answer, const Asked& asked) {
  std::vector<Row> rows, constraints;
  for (const ActiveLimit& a : answer.active) rows.push_back(active_row(a));
  for (const Constraint& c : asked.constraints)
    constraints.push_back({c.name, constraint_cell(&answer.start, c), constraint_cell(found_of(answer), c),
                           std::isnan(c.bounds.lower) ? "" : number_text(c.bounds.lower),
                           std::isnan(c.bounds.upper) ? "" : number_text(c.bounds.upper), unit_of_name(c.quantity)});
  std::string html, broken;
  if (!rows.empty())
    html +=
        "<p>What the best layout comes near to: distances within 1 mm, angles within 1 degree, constraints and "
        "loads within 5 % of their bound, parameters within 1 % of the way between theirs.</p>\n" +
        html_table("study-active", {"kind", "name", "value", "bound", "left", "unit"}, rows);
  else if (answer.best)
    html += "<p>The best layout comes near to no limit and no bound.</p>\n";
  if (!constraints.empty())
    html += "<h3>Constraints</h3>\n" +
            html_table("study-constraints",
                       {"constraint", "start", answer.best ? "best" : "breaks least", "at least", "at most", "unit"},
                       constraints);
  const auto list = [&](const char* which, const DesignAnswer* design) {
    if (!design || !design->violated) return;
    for (const std::string& words : *design->violated)
      broken += fmt::format("<li>{}: {}</li>\n", which, html_escaped(words));
  };
  list("Start", &answer.start);
  list("Breaks least", answer.least_violating ? &*answer.least_violating : nullptr);
  if (!broken.empty()) html += "<h3>Broken limits</h3>\n<ul>\n" + broken + "</ul>\n";
  return section_of("active", "Limits", "What limits it", html);
}

}  // namespace beltlife::optimize_page
