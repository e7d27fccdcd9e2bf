// Owns what tests of study pages share: whether a page is sound, what it has, and records made by hand.
#pragma once

#include <map>
#include <regex>

#include "calibrate/pages/calibrate_page.h"
#include "optimize/pages/optimize_page.h"
#include "studies/pages.h"
#include "tests/unit/study_fixture.h"

namespace beltlife::study_test {

/// Every tag is closed by its own, every id stands once, and every link leads somewhere on the page.
inline void expect_sound(const std::string& page) {
  const std::regex tag(R"(<(/?)([A-Za-z!][A-Za-z0-9]*)(?:[^<>"']|"[^"]*"|'[^']*')*>)");
  std::vector<std::string> open;
  for (std::sregex_iterator i(page.begin(), page.end(), tag), end; i != end; ++i) {
    const std::string whole = i->str(), name = (*i)[2];
    if (name.starts_with("!") || name == "meta" || whole.ends_with("/>")) continue;
    if ((*i)[1].length() == 0) {
      open.push_back(name);
      continue;
    }
    ASSERT_FALSE(open.empty()) << whole;
    EXPECT_EQ(open.back(), name) << page.substr(static_cast<std::size_t>(i->position()), 80);
    open.pop_back();
  }
  EXPECT_TRUE(open.empty()) << open.back();
  std::map<std::string, int> count;
  const std::regex id(R"(\bid=['"]([^'"]+)['"])"), link(R"(href=["']#([^"']+)["'])");
  for (std::sregex_iterator i(page.begin(), page.end(), id), end; i != end; ++i) ++count[(*i)[1]];
  for (const auto& [name, times] : count) EXPECT_EQ(times, 1) << name;
  for (std::sregex_iterator i(page.begin(), page.end(), link), end; i != end; ++i)
    EXPECT_EQ(count[(*i)[1]], 1) << i->str();
  EXPECT_EQ(page.find("<script"), page.npos);
  EXPECT_EQ(page.find("src="), page.npos);
}

/// The page as the command report makes it.
inline std::string page_of_study(const StudyRecord& record, const std::string& name) {
  std::vector<StudyPage> pages(study_pages().begin(), study_pages().end());
  pages.push_back(calibration_page());
  pages.push_back(layout_search_page());
  return study_html(record, name, pages);
}

inline bool has_id(const std::string& page, const std::string& id) {
  return page.find("id=\"" + id + "\"") != page.npos;
}

inline void expect_ids(const std::string& page, std::initializer_list<const char*> ids) {
  for (const char* id : ids) EXPECT_TRUE(has_id(page, id)) << id;
}

inline StudyRecord record_of(const std::string& driver, std::vector<std::string> parameters,
                             std::vector<std::string> quantities) {
  StudyRecord r;
  r.head = example_head();
  r.head.driver = driver;
  r.head.parameters = std::move(parameters);
  r.head.quantities = std::move(quantities);
  return r;
}

inline void add_point(StudyRecord& r, Point settings, std::vector<double> values, double processor_s = 0.5) {
  r.points.push_back({r.points.size(), std::move(settings), {PointState::ok, "", std::move(values), processor_s}});
}

inline void add_failure(StudyRecord& r, Point settings, std::string reason) {
  r.points.push_back({r.points.size(), std::move(settings), {PointState::diverged, std::move(reason), {}, 0.5}});
}

/// What a page must escape.
constexpr const char* odd_name = "B1.<b>'x' & \"y\" 50 %.torque_n_m";

}  // namespace beltlife::study_test
