// The part of a page that is of sampled shares of the variance: see sobol_page.h.
#include "studies/sobol/sobol_page.h"

#include <fmt/format.h>

#include <cmath>

#include "sim/eval/quantity_unit.h"
#include "studies/shares_page.h"

namespace beltlife {
namespace {

std::string convergence_of(const StudyRecord& record, const SobolAnswer& answer, const QuantityShares& q) {
  if (!std::isfinite(q.widest_interval)) return "";
  std::string words = fmt::format(
      "{}: the widest interval of a share with interactions, that of {}, is {} wide; {} is asked for.",
      q.converged ? "Converged" : "<span class=\"alarm\">Not converged</span>", html_escaped(q.widest_parameter),
      digits_text(q.widest_interval, 2), digits_text(answer.convergence_width, 2));
  if (!q.converged && q.samples_needed > 0)
    words += fmt::format(" About {:.0f} samples ({:.0f} points) would be needed: widths shrink with the root.",
                         q.samples_needed, q.samples_needed * static_cast<double>(record.head.parameters.size() + 2));
  return words;
}

SharedQuantity shared_of(const StudyRecord& record, const SobolAnswer& answer, const std::string& name,
                         const QuantityShares& q) {
  SharedQuantity shared{name, {}, q.sum_first, {}};
  const auto share = [](const std::map<std::string, Share>& shares, const std::string& parameter) {
    const auto at = shares.find(parameter);
    return at == shares.end() ? Estimate{} : Estimate{at->second};
  };
  for (const std::string& parameter : record.head.parameters) {
    ParameterShares p{parameter, share(q.first, parameter), share(q.total, parameter)};
    if (std::isfinite(p.first.value) || std::isfinite(p.total.value)) shared.shares.push_back(std::move(p));
  }
  sort_by_total(shared.shares);
  const std::string unit = html_escaped(unit_of_name(name));
  shared.about =
      fmt::format("Mean {}, standard deviation {}{}. {}", digits_text(q.mean, 5), digits_text(std::sqrt(q.variance)),
                  unit.empty() ? "" : " " + unit, convergence_of(record, answer, q));
  return shared;
}

std::string convergence_in_words(std::size_t judged, std::size_t converged) {
  if (judged == 0) return "";
  if (converged == judged) return judged == 1 ? "It has converged. " : "All quantities have converged. ";
  if (judged == 1) return "<a class=\"alarm\" href=\"#shares\">It has not converged</a>. ";
  return fmt::format("<a class=\"alarm\" href=\"#shares\">{} of {} quantities {} not converged</a>. ",
                     judged - converged, judged, judged - converged == 1 ? "has" : "have");
}

}  // namespace

StudyPart sobol_part(const StudyRecord& record, const SobolAnswer& answer) {
  std::vector<SharedQuantity> quantities;
  std::size_t judged = 0, converged = 0;
  for (const std::string& name : record.head.quantities) {
    const auto found = answer.quantities.find(name);
    if (found == answer.quantities.end()) continue;
    quantities.push_back(shared_of(record, answer, name, found->second));
    if (!std::isfinite(found->second.widest_interval)) continue;
    ++judged;
    converged += found->second.converged;
  }
  StudyPart part;
  part.lead = error_words(answer) + shares_in_words(quantities) + convergence_in_words(judged, converged);
  part.key_numbers = {{"base rows", std::to_string(answer.rows)},
                      {"of them used", Cell(std::to_string(answer.rows_used), answer.rows_used < answer.rows)},
                      {"confidence, %", digits_text(100 * answer.confidence)}};
  if (const std::string html = shares_html(quantities); !html.empty())
    part.sections.push_back({"shares", "Shares of the variance",
                             "<section id=\"shares\"><h2>Shares of the variance</h2>\n<p>" + std::string(about_shares) +
                                 " Whiskers are intervals by the bootstrap.</p>\n" + html + "</section>\n"});
  return part;
}

}  // namespace beltlife
