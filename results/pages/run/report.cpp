// The report page: see report.h.
#include "results/pages/run/report.h"

#include "results/pages/page.h"
#include "results/pages/run/report_animation.h"
#include "results/pages/run/report_sections.h"

namespace beltlife {

std::string report_html(const ResultFile& file, const std::string& name) {
  const Subject s = subject_of(file, name);
  return page_html(s.model.scene.title.empty() ? name : s.model.scene.title,
                   {{"summary", "", summary_section(s)},
                    {"layout", "Layout", layout_section(s)},
                    {"animation", "Running belt", animation_section(s)},
                    {"life", "Life", life_section(s)},
                    {"statics", "Statics", statics_section(s)},
                    {"modes", "Modes", modes_section(s)},
                    {"sweep", "Sweep", sweep_section(s)},
                    {"event", "Event", event_section(s)},
                    {"losses", "Power and losses", losses_section(s)},
                    {"ranges", "Ranges", ranges_section(s)},
                    {"warnings", "Warnings", warnings_section(s)},
                    {"provenance", "How these numbers came about", provenance_section(s)}});
}

}  // namespace beltlife
