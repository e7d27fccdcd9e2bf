// The page about a study: see study_page.h.
#include "results/pages/study/study_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "results/pages/study/study_parts.h"
#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

/// A kind that has no row has the common sections, and its answer as it is.
StudyPage page_of(const StudyHead& head, std::span<const StudyPage> pages) {
  const auto at = std::find_if(pages.begin(), pages.end(), [&](const StudyPage& p) { return p.driver == head.driver; });
  return at != pages.end() ? *at : StudyPage{head.driver, "", "", nullptr, true, ""};
}

/// What was studied, by its own name; the scene may be of a version that is not understood any more.
std::string subject_of(const StudyHead& head) {
  if (head.scene_text.empty()) return head.study_path;
  try {
    if (const std::string title = parse_scene(head.scene_text, "scene").title; !title.empty()) return title;
  } catch (const BadInput&) {
    // The text stands below, as provenance.
  }
  return std::filesystem::path(head.scene_path).filename().string();
}

Section summary(const StudyRecord& record, const StudyPage& kind, StudyPart part, bool ended) {
  double processor_s = 0;
  std::size_t failed = 0;
  for (const StudyPoint& p : record.points) {
    processor_s += p.answer.processor_s;
    failed += !p.answer.ok();
  }
  std::string lead;
  if (!ended)
    lead = fmt::format(
        "<strong class=\"alarm\">This study has not ended.</strong> Its log holds {}; the command below goes on from "
        "there. ",
        count_text(record.points.size(), "point"));
  lead += part.lead;
  std::string about = *kind.about ? fmt::format("The question: {}. ", kind.about) : std::string();
  about += fmt::format("{} evaluated in {} of processor time", count_text(record.points.size(), "point"),
                       duration_text(processor_s));
  about += failed == 0 ? std::string("; all are ok.")
                       : fmt::format("; <a href=\"#failures\">{} not ok</a>.",
                                     failed == 1 ? std::string("1 is") : fmt::format("{} are", failed));
  std::vector<Row> rows = std::move(part.key_numbers);
  rows.insert(rows.begin(), {"studied", subject_of(record.head)});
  rows.push_back({"points", std::to_string(record.points.size())});
  rows.push_back({"points not ok", std::to_string(failed)});
  rows.push_back({"processor time in all", duration_text(processor_s)});
  rows.push_back({"ended", Cell(ended ? "yes" : "no", !ended)});
  std::string html = "<section id=\"summary\">";
  if (!lead.empty()) html += "<p class=\"lead\">" + lead + "</p>\n";
  return {"summary", "", html + "<p>" + about + "</p>\n" + html_table("key-numbers", {"", ""}, rows) + "</section>\n"};
}

}  // namespace

std::string study_html(const StudyRecord& record, const std::string& name, std::span<const StudyPage> pages) {
  const StudyPage kind = page_of(record.head, pages);
  const bool ended = !record.answer.is_null();
  StudyPart part;
  if (kind.part && record.answer.is_object()) part = kind.part(record);
  std::vector<Section> own = std::move(part.sections);
  std::vector<Section> sections{summary(record, kind, std::move(part), ended)};
  sections.insert(sections.end(), own.begin(), own.end());
  if (ended && !kind.part)
    sections.push_back({"answer", "Answer",
                        "<section id=\"answer\"><h2>Answer</h2>\n<details><summary>As the log has it</summary><pre>" +
                            html_escaped(record.answer.dump(2)) + "</pre></details></section>\n"});
  sections.push_back(failures_section(record, kind.failures));
  if (kind.scatters) sections.push_back(points_section(record));
  sections.push_back(study_provenance_section(record, name));
  return page_html((*kind.title ? kind.title : record.head.driver) + std::string(": ") + subject_of(record.head),
                   sections);
}

}  // namespace beltlife
