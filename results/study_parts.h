// Owns what the pages of studies are put together from: the kinds' own parts, the common sections, answers as words.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "results/html.h"
#include "results/journal.h"
#include "results/page.h"

namespace beltlife {

/// What a kind of study adds to its page.
struct StudyPart {
  std::string lead;              ///< HTML: the answer in sentences
  std::vector<Row> key_numbers;  ///< name and value
  std::vector<Section> sections;
};

/// Each is called with an answer that is an object; what is missing in it is left out of the page.
StudyPart noise_part(const StudyRecord& record);
StudyPart convergence_part(const StudyRecord& record);
StudyPart stability_part(const StudyRecord& record);
StudyPart oat_part(const StudyRecord& record);
StudyPart morris_part(const StudyRecord& record);
StudyPart sobol_part(const StudyRecord& record);
StudyPart surrogate_part(const StudyRecord& record);
StudyPart uncertainty_part(const StudyRecord& record);
StudyPart calibrate_part(const StudyRecord& record);
StudyPart optimize_part(const StudyRecord& record);

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

/// So many significant digits, "-" for no number; `percent_text` of a share.
std::string digits_text(double value, int digits = 3);
std::string percent_text(double share, int digits = 2);
/// 12.3 s, 4.2 min, 1.6 h
std::string duration_text(double seconds);
/// "0.1 to 0.3", "-" where an end is missing.
std::string interval_text(const nlohmann::json& interval, int digits = 3);
/// "torque_n_m, N m"; the name alone if it states no unit.
std::string with_unit(const std::string& name);
std::string setting_text(const Setting& setting);
/// "1 point", "7 points"
std::string count_text(std::size_t count, std::string_view noun);

}  // namespace beltlife
