// The page that compares result files: see report_compare.h.
#include "results/pages/run/report_compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>

#include "results/pages/layout_svg.h"
#include "results/pages/page.h"
#include "results/pages/run/report_compare_parts.h"
#include "results/pages/run/scene_differences.h"

namespace beltlife {
namespace {

using namespace compare_page;
namespace fs = std::filesystem;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// The files' names without ending; where two are alike, whole paths, and those numbered where they are alike, too.
std::vector<std::string> labels_of(const std::vector<ComparedFile>& files) {
  std::vector<std::string> labels;
  const auto alike = [&] { return std::set<std::string>(labels.begin(), labels.end()).size() < labels.size(); };
  for (const ComparedFile& file : files) labels.push_back(fs::path(file.path).stem().string());
  if (alike())
    for (std::size_t i = 0; i < files.size(); ++i) labels[i] = files[i].path;
  if (alike())
    for (std::size_t i = 0; i < files.size(); ++i) labels[i] += fmt::format(" ({})", i + 1);
  return labels;
}

double life_of(const Contender& side) {
  return side.subject.life && !side.subject.life->error ? side.subject.life->life_h : none;
}

std::vector<std::string> life_ranges(const Contender& side) {
  std::vector<std::string> names;
  if (side.subject.life)
    for (const RangeLife& range : side.subject.life->ranges) names.push_back(range.name);
  return names;
}

/// Whether the lives are over ranges of the same names, so that their ratio says something.
bool lives_compare(const Contender& a, const Contender& b) {
  auto x = life_ranges(a), y = life_ranges(b);
  std::ranges::sort(x);
  std::ranges::sort(y);
  return x == y;
}

std::string factor_text(double life, double first) {
  const double factor = life / first;
  return std::isfinite(factor) ? html_rounded(factor, 3) : "-";
}

/// A row of words, one a side.
template <class Words>
Row row_of(const char* name, const Contenders& sides, Words words) {
  Row row{name};
  for (const Contender& side : sides) row.push_back(words(side));
  return row;
}

Row labels_header(const char* first, const Contenders& sides) {
  return row_of(first, sides, [](const Contender& side) { return side.label; });
}

/// Largest of a number over all ranges, and in which.
template <class Value>
std::string extreme(const Contender& side, Value value, double sign) {
  double best = none;
  std::string at;
  for (const auto& range : side.subject.ranges)
    for (const auto& [number, part] : value(range.summary))
      if (std::isnan(best) || sign * number > sign * best) {
        best = number;
        at = part + ", " + range.window->range;
      }
  return std::isnan(best) ? "-" : html_number(best) + " (" + at + ")";
}

using Numbers = std::vector<std::pair<double, std::string>>;

std::string key_table(const Contenders& sides) {
  std::vector<Row> rows;
  const auto title = [](const Contender& s) { return s.subject.model.scene.title; };
  if (std::ranges::any_of(sides, [&](const Contender& s) { return !title(s).empty(); }))
    rows.push_back(row_of("scene", sides, [&](const Contender& s) { return title(s).empty() ? "-" : title(s); }));
  if (std::ranges::any_of(sides, [](const Contender& s) { return !std::isnan(life_of(s)); })) {
    rows.push_back(row_of("life h", sides, [](const Contender& s) { return html_rounded(life_of(s), 3); }));
    rows.push_back(row_of("factor against the first", sides, [&](const Contender& s) {
      return lives_compare(s, sides.front()) ? factor_text(life_of(s), life_of(sides.front())) : "-";
    }));
    rows.push_back(
        row_of("life over", sides, [](const Contender& s) { return s.subject.life ? life_over(s.subject) : "-"; }));
  }
  const auto spans = [](double SpanSummary::*member) {
    return [member](const RangeSummary& s) {
      Numbers numbers;
      for (const SpanSummary& span : s.spans) numbers.emplace_back(span.*member, span.name);
      return numbers;
    };
  };
  const auto hubs = [](const RangeSummary& s) {
    Numbers numbers;
    for (const PulleySummary& pulley : s.pulleys) numbers.emplace_back(pulley.hub_load_n_max, pulley.name);
    return numbers;
  };
  const auto add = [&](const char* name, auto value, double sign) {
    Row row = row_of(name, sides, [&](const Contender& s) { return extreme(s, value, sign); });
    if (std::any_of(row.begin() + 1, row.end(), [](const Cell& c) { return c.text != "-"; }))
      rows.push_back(std::move(row));
  };
  add("highest tension N", spans(&SpanSummary::tension_n_max), 1);
  add("lowest tension N", spans(&SpanSummary::tension_n_min), -1);
  add("highest hub load N", hubs, 1);
  if (std::ranges::any_of(sides, [](const Contender& s) { return s.subject.model.pulleys > 0; })) {
    rows.push_back(row_of("tension at rest N", sides, [](const Contender& s) {
      return s.subject.model.pulleys > 0 ? html_number(s.subject.model.statics.balance.tension) : "-";
    }));
    rows.push_back(row_of("belt length, unstretched mm", sides, [](const Contender& s) {
      return html_number(1e3 * s.subject.model.statics.unstretched_length, 1);
    }));
  }
  Row heed{"warnings"};
  for (const Contender& side : sides) {
    const auto count = warnings(side.subject).size();
    heed.push_back(Cell(count == 0 ? "none" : std::to_string(count), count > 0));
  }
  rows.push_back(std::move(heed));
  return html_table("key-numbers", labels_header("", sides), rows);
}

/// What of the difference is not of the drive but of how it was computed.
std::string numerical_note(const std::vector<SceneDifference>& differences) {
  std::vector<std::string> fields;
  for (const SceneDifference& d : differences)
    if (d.path.starts_with("solver.") || d.path == "belt.elements") fields.push_back(d.path);
  if (fields.empty()) return "";
  return fmt::format("They also differ in how they were computed ({}), which accounts for a part of any difference. ",
                     html_escaped(fmt::format("{}", fmt::join(fields, ", "))));
}

std::string summary_section(const Contenders& sides, const std::vector<SceneDifference>& differences) {
  std::string words;
  const Contender& first = sides.front();
  for (std::size_t i = 1; i < sides.size(); ++i) {
    const Contender& other = sides[i];
    const double factor = life_of(other) / life_of(first);
    if (std::isnan(factor) || std::isinf(factor) || factor <= 0 || !lives_compare(other, first)) continue;
    words += fmt::format("The belt of <strong>{}</strong> lives <strong>{} times</strong> as long as that of {}. ",
                         html_escaped(other.label), html_rounded(factor, 3), html_escaped(first.label));
  }
  if (words.empty())
    words = fmt::format("{} result files side by side; their lives cannot be compared. ", sides.size());
  words += differences.empty() ? "Their scenes are the same. "
                               : fmt::format("Their scenes differ in <a href=\"#scenes\">{} field{}</a>. ",
                                             differences.size(), differences.size() == 1 ? "" : "s");
  return "<section id=\"summary\"><p class=\"lead\">" + words + numerical_note(differences) + "</p>\n" +
         key_table(sides) + "</section>\n";
}

/// Drawn in the range that wears the first drive most, where a file has it, else at rest.
std::string layout_section(const Contenders& sides) {
  const Subject::Range* worst = shown_range(sides.front().subject);
  std::vector<DrawnState> states;
  SharedDrawing shared;
  int drawn = 0;
  for (const Contender& side : sides) {
    states.push_back(drawn_state(side.subject, worst ? range_of(side, worst->window->range) : nullptr));
    if (side.subject.model.pulleys == 0) continue;
    make_room(shared, side.subject.model, states.back().arm, states.back().tension);
    ++drawn;
  }
  if (drawn == 0) return "";
  std::string html;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (sides[i].subject.model.pulleys == 0) continue;
    if (i > 0 && sides.front().subject.model.pulleys > 0) {
      shared.beneath = &sides.front().subject.model;
      shared.beneath_arm = states.front().arm;
    }
    html +=
        "<div><h3>" + html_escaped(sides[i].label) + "</h3>\n" +
        layout_svg(sides[i].subject.model, states[i].arm, states[i].tension, fmt::format("layout-{}", i + 1), shared) +
        "</div>\n";
  }
  return fmt::format(
             "<section id=\"layout\"><h2>Layouts</h2><p>To one scale and with the same colours. {}Dashed: {}, in the "
             "scenes' coordinates.</p>\n<div class=\"charts\">",
             worst ? "Mean tensions in range " + html_escaped(worst->window->range) + ". " : "Drawn at rest. ",
             html_escaped(sides.front().label)) +
         html + "</div></section>\n";
}

std::string life_section(const Contenders& sides) {
  const auto names = all_names(sides, life_ranges);
  if (names.empty()) return "";
  Row header{"range"};
  for (std::size_t i = 0; i < sides.size(); ++i)
    for (const char* what : {"life h", "log10", "factor"})
      if (i > 0 || std::string(what) != "factor") header.push_back(sides[i].label + ": " + what);
  std::vector<Row> rows;
  const auto add = [&](const std::string& name, const std::vector<double>& lives) {
    Row row{name};
    for (std::size_t i = 0; i < lives.size(); ++i) {
      row.push_back(html_number(lives[i]));
      row.push_back(html_number(std::log10(lives[i]), 2));
      if (i > 0) row.push_back(factor_text(lives[i], lives.front()));
    }
    rows.push_back(std::move(row));
  };
  for (const std::string& name : names) {
    std::vector<double> lives;
    for (const Contender& side : sides) {
      lives.push_back(none);
      if (side.subject.life)
        for (const RangeLife& range : side.subject.life->ranges)
          if (range.name == name && !range.error) lives.back() = range.life_h;
    }
    add(name, lives);
  }
  const bool same = std::ranges::all_of(sides, [&](const Contender& s) { return lives_compare(s, sides.front()); });
  if (same) {  // over other ranges the sums would be of different things
    std::vector<double> lives;
    for (const Contender& side : sides) lives.push_back(life_of(side));
    add("all of them, by their shares of time", lives);
  }
  return "<section id=\"life\"><h2>Life</h2>\n" + html_table("life-ranges", header, rows) + "</section>\n";
}

std::string scenes_section(const Contenders& sides, const std::vector<SceneDifference>& differences) {
  std::string html = "<section id=\"scenes\"><h2>What differs between the scenes</h2>\n";
  if (differences.empty()) return html + "<p>Nothing.</p></section>\n";
  constexpr std::size_t longest = 60, many = 40;  // letters of a value; rows that stand open
  std::vector<Row> rows;
  for (const SceneDifference& d : differences) {
    Row row{d.path};
    for (const std::string& value : d.values)
      row.push_back(value.size() <= longest ? value : value.substr(0, longest - 3) + "...");
    rows.push_back(std::move(row));
  }
  const std::string table = html_table("scenes-table", labels_header("field", sides), rows);
  if (rows.size() <= many) return html + table + "</section>\n";
  return html + fmt::format("<details><summary>{} fields</summary>\n", rows.size()) + table + "</details></section>\n";
}

std::string warnings_section(const Contenders& sides) {
  std::string html = "<section id=\"warnings\"><h2>Warnings</h2>\n";
  for (const Contender& side : sides) {
    html += "<h3>" + html_escaped(side.label) + "</h3>\n";
    const auto list = warnings(side.subject);
    if (list.empty()) html += "<p>None.</p>\n";
    if (!list.empty()) html += "<ul>";
    for (const std::string& words : list) html += "<li>" + html_escaped(words) + "</li>\n";
    if (!list.empty()) html += "</ul>\n";
  }
  return html + "</section>\n";
}

std::string provenance_section(const Contenders& sides, const std::vector<ComparedFile>& files) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Provenance& p = sides[i].subject.file.provenance;
    rows.push_back({sides[i].label + ": file", files[i].path});
    rows.push_back({"command", p.command_line});
    rows.push_back({"beltlife", p.version + " (" + p.revision + "), " + p.compiler});
    rows.push_back(
        {"scheme", fmt::format("{}, {} elements, step {:.3g} s", p.scheme, p.elements,
                               sides[i].subject.file.runs.empty() ? 0 : sides[i].subject.file.runs[0].step_s)});
  }
  return "<section id=\"provenance\"><h2>How these numbers came about</h2>\n" +
         html_table("provenance-table", {"", ""}, rows) + "</section>\n";
}

}  // namespace

std::string comparison_html(const std::vector<ComparedFile>& files) {
  Contenders sides;
  const auto labels = labels_of(files);
  std::vector<const SceneSpec*> scenes;
  for (std::size_t i = 0; i < files.size(); ++i) sides.push_back({labels[i], subject_of(files[i].file, files[i].path)});
  for (const Contender& side : sides) scenes.push_back(&side.subject.model.scene);
  const auto differences = scene_differences(scenes);
  return page_html(fmt::format("{}", fmt::join(labels, " beside ")),
                   {{"summary", "", summary_section(sides, differences)},
                    {"layout", "Layouts", layout_section(sides)},
                    {"life", "Life", life_section(sides)},
                    {"scenes", "What differs", scenes_section(sides, differences)},
                    {"ranges", "Ranges", compare_page::ranges_section(sides)},
                    {"warnings", "Warnings", warnings_section(sides)},
                    {"provenance", "How these numbers came about", provenance_section(sides, files)}});
}

std::string comparison_page_beside(const std::vector<std::string>& files) {
  const auto stem = [](const std::string& file) { return fs::path(file).stem().string(); };
  const std::string more = files.size() > 2 ? fmt::format("_and_{}_more", files.size() - 2) : "";
  return (fs::path(files.at(0)).parent_path() / (stem(files[0]) + "_vs_" + stem(files.at(1)) + more + ".html"))
      .string();
}

}  // namespace beltlife
