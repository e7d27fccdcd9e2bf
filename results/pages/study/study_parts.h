// Owns what the pages of studies are put together from: the kinds' own parts, the common sections, answers as words.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "results/answer/answer_json.h"
#include "results/journal/study_record.h"
#include "results/pages/html.h"
#include "results/pages/page.h"

namespace beltlife {

/// What a kind of study adds to its page.
struct StudyPart {
  std::string lead;              ///< HTML: the answer in sentences
  std::vector<Row> key_numbers;  ///< name and value
  std::vector<Section> sections;
};

/// The part of a page whose kind reads its answer as a type of its own.
template <class Answer, StudyPart (*part)(const StudyRecord&, const Answer&)>
StudyPart typed_part(const StudyRecord& record) {
  return part(record, answer_of_json<Answer>(record.answer));
}

/// Points that are not ok: counted by reason, and the first of them; `note` (HTML) is what the kind says of them.
Section failures_section(const StudyRecord& record, const std::string& note);
/// Quantities against parameters, small charts; empty if nothing varies.
Section points_section(const StudyRecord& record);
Section study_provenance_section(const StudyRecord& record, const std::string& name);

/// Reading an answer without a throw: null stands for what is not there (also for NaN and infinity, which JSON lacks).
const nlohmann::json& part_of(const nlohmann::json& answer, std::string_view key);
/// Entries of a list that are objects.
std::vector<nlohmann::json> rows_of(const nlohmann::json& answer, std::string_view key);
double number_in(const nlohmann::json& answer, std::string_view key);  ///< NaN if there is none
bool flag_in(const nlohmann::json& answer, std::string_view key);      ///< false if there is none
std::string text_in(const nlohmann::json& answer, std::string_view key);
std::vector<std::string> texts_in(const nlohmann::json& answer, std::string_view key);

/// HTML: why there is no answer; empty if the answer names no error.
std::string error_words(const nlohmann::json& answer);
std::string error_words(const DriverAnswer& answer);

/// So many significant digits, "-" for no number; `percent_text` of a share.
std::string digits_text(double value, int digits = 3);
std::string percent_text(double share, int digits = 2);
/// 12.3 s, 4.2 min, 1.6 h
std::string duration_text(double seconds);
/// "0.1 to 0.3", "-" where an end is missing.
std::string interval_text(const nlohmann::json& interval, int digits = 3);
std::string interval_text(double low, double high, int digits = 3);
/// "torque_n_m, N m"; the name alone if it states no unit.
std::string with_unit(const std::string& name);
std::string setting_text(const Setting& setting);
/// "1 point", "7 points"
std::string count_text(std::size_t count, std::string_view noun);

}  // namespace beltlife
