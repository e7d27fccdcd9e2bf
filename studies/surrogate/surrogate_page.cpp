// The part of a page that is of a surrogate: how good it is, and its shares of the variance; see surrogate_page.h.
#include "studies/surrogate/surrogate_page.h"

#include <fmt/format.h>

#include <cmath>

#include "sim/eval/quantity_unit.h"
#include "studies/shares_page.h"

namespace beltlife {
namespace {

constexpr double usable_q2 = 0.9;

SharedQuantity shared_of(const StudyRecord& record, const std::string& name, const QuantitySurrogate& q) {
  SharedQuantity shared{name, {}, {}, {}};
  const auto share = [](const std::map<std::string, double>& shares, const std::string& parameter) {
    const auto at = shares.find(parameter);
    return Estimate{at == shares.end() ? not_known : at->second};
  };
  for (const std::string& parameter : record.head.parameters) {
    ParameterShares p{parameter, share(q.first, parameter), share(q.total, parameter)};
    if (std::isfinite(p.first.value) || std::isfinite(p.total.value)) shared.shares.push_back(std::move(p));
  }
  sort_by_total(shared.shares);
  shared.about = fmt::format("Q&sup2; = <span{}>{}</span>.", q.q2 < usable_q2 ? " class=\"alarm\"" : "",
                             std::isfinite(q.q2) ? html_number(q.q2, 4) : "not defined");
  return shared;
}

Row row_of(const std::string& name, const QuantitySurrogate& q) {
  const bool varies = std::isfinite(q.q2), ran = std::isfinite(q.nominal.simulated);
  return {name,
          Cell(varies ? html_number(q.q2, 4) : "does not vary", q.q2 < usable_q2),
          std::to_string(q.terms),
          digits_text(q.nominal.predicted, 6),
          ran ? digits_text(q.nominal.simulated, 6) : "failed",
          ran ? digits_text(q.nominal.predicted - q.nominal.simulated, 2) : "failed",
          unit_of_name(name)};
}

std::string quality_in_words(std::size_t judged, std::size_t poor) {
  if (poor > 0)
    return fmt::format(
        "<a class=\"alarm\" href=\"#surrogate\">The surrogate of {} predicts less than {} % of the variance</a>: do "
        "not rely on its shares. ",
        poor == 1 ? std::string("one quantity") : fmt::format("{} quantities", poor), 100 * usable_q2);
  if (judged == 0) return "";
  return fmt::format("The surrogate predicts at least {} % of the variance at points that it was not fitted to. ",
                     100 * usable_q2);
}

}  // namespace

StudyPart surrogate_part(const StudyRecord& record, const SurrogateAnswer& answer) {
  std::vector<SharedQuantity> quantities;
  std::vector<Row> rows;
  std::size_t judged = 0, poor = 0;
  for (const std::string& name : record.head.quantities) {
    const auto found = answer.quantities.find(name);
    if (found == answer.quantities.end()) continue;
    const QuantitySurrogate& q = found->second;
    judged += std::isfinite(q.q2);
    poor += q.q2 < usable_q2;
    rows.push_back(row_of(name, q));
    quantities.push_back(shared_of(record, name, q));
  }
  StudyPart part;
  part.lead = error_words(answer) + shares_in_words(quantities) + quality_in_words(judged, poor);
  part.key_numbers = {
      {"method", answer.method},
      {"samples", std::to_string(answer.samples)},
      {"of them used", Cell(std::to_string(answer.samples_used), answer.samples_used < answer.samples)}};
  if (!rows.empty())
    part.sections.push_back(
        {"surrogate", "Surrogate",
         "<section id=\"surrogate\"><h2>How good the surrogate is</h2>\n<p>Q&sup2; is the share of the variance that "
         "is predicted at points left out in turn; below 0.9 it is not usable. The surrogate was not fitted to the "
         "nominal point.</p>\n" +
             html_table("study-surrogate",
                        {"quantity", "Q²", "coefficients", "nominal predicted", "simulated", "difference", "unit"},
                        rows) +
             "</section>\n"});
  if (const std::string html = shares_html(quantities); !html.empty())
    part.sections.push_back({"shares", "Shares of the variance",
                             "<section id=\"shares\"><h2>Shares of the variance</h2>\n<p>" + std::string(about_shares) +
                                 " They are the surrogate's; its own error is not in them.</p>\n" + html +
                                 "</section>\n"});
  return part;
}

}  // namespace beltlife
