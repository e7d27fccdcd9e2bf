// Error against run time: see convergence.h.
#include "studies/convergence/convergence.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace beltlife {
namespace {

struct Group {
  std::string name, pattern;
  enum { relative, of_largest, difference } measure;
};

const std::vector<Group> groups{{"order 3", ".order_3", Group::relative},
                                {"order 6", ".order_6", Group::relative},
                                {"tensions", ".tension_n.", Group::relative},
                                {"slip", ".slip_percent", Group::of_largest},
                                {"normal force, 1 kHz", ".normal_n.sampled", Group::relative},
                                {"normal force, resolved", ".normal_n.resolved", Group::relative},
                                {"friction force, 1 kHz", ".tangential_n.sampled", Group::of_largest},
                                {"friction force, resolved", ".tangential_n.resolved", Group::of_largest},
                                {"stresses", ".sigma_", Group::relative},
                                {"log10 life", "log10_life_h", Group::difference},
                                {"other", "", Group::relative}};

const Group& group_of(const std::string& quantity) {
  return *std::find_if(groups.begin(), groups.end(), [&](const Group& g) {
    const std::size_t at = quantity.find(g.pattern);
    // order_3 is not order_3.5
    return at != quantity.npos && (!g.pattern.starts_with(".order") || at + g.pattern.size() == quantity.size());
  });
}

bool is_explicit(const NumericalRun& r) { return r.ok() && r.scheme != "linearly_implicit"; }

}  // namespace

const std::vector<std::string>& quantity_groups() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Group& g : groups) list.push_back(g.name);
    return list;
  }();
  return names;
}

std::string quantity_group(const std::string& quantity) { return group_of(quantity).name; }

bool of_one_element(const std::string& quantity) {
  return quantity.find(".normal_n.") != quantity.npos || quantity.find(".tangential_n.") != quantity.npos;
}

std::vector<double> as_errors(const std::vector<std::string>& quantities, const std::vector<double>& reference,
                              const std::vector<double>& differences) {
  std::map<std::string, double> largest;  // by range and group
  const auto key = [&](std::size_t q) {
    return quantities[q].substr(0, quantities[q].find('.')) + group_of(quantities[q]).name;
  };
  for (std::size_t q = 0; q < quantities.size(); ++q)
    largest[key(q)] = std::max(largest[key(q)], std::abs(reference[q]));
  std::vector<double> errors;
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    const auto measure = group_of(quantities[q]).measure;
    const double scale = measure == Group::difference   ? 1
                         : measure == Group::of_largest ? largest[key(q)]
                                                        : std::abs(reference[q]);
    errors.push_back(std::abs(differences[q]) / (scale > 0 ? scale : 1));
  }
  return errors;
}

std::vector<double> errors_of(const std::vector<std::string>& quantities, const std::vector<double>& reference,
                              const std::vector<double>& values) {
  std::vector<double> differences;
  for (std::size_t q = 0; q < quantities.size(); ++q) differences.push_back(values[q] - reference[q]);
  return as_errors(quantities, reference, differences);
}

std::optional<std::size_t> reference_run(const std::vector<NumericalRun>& runs) {
  std::optional<std::size_t> best;
  const auto better = [&](const NumericalRun& a, const NumericalRun& b) {
    if (a.elements != b.elements) return a.elements > b.elements;
    if (a.step_s != b.step_s) return a.step_s < b.step_s;
    return a.scheme == "thesis" && b.scheme != "thesis";
  };
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (is_explicit(runs[i]) && (!best || better(runs[i], runs[*best]))) best = i;
  return best;
}

std::vector<double> reference_band(const std::vector<NumericalRun>& runs, std::size_t reference) {
  const NumericalRun& ref = runs[reference];
  const NumericalRun *longer = nullptr, *other = nullptr;
  std::vector<const NumericalRun*> meshes;  // finest step of the reference's scheme, finest mesh first
  for (const NumericalRun& r : runs) {
    if (!is_explicit(r) || &r == &ref) continue;
    if (r.elements == ref.elements && r.scheme == ref.scheme && (!longer || r.step_s < longer->step_s)) longer = &r;
    if (r.elements == ref.elements && r.scheme != ref.scheme && (!other || r.step_s < other->step_s)) other = &r;
    if (r.elements == ref.elements || r.scheme != ref.scheme) continue;
    const auto same = std::find_if(meshes.begin(), meshes.end(), [&](auto* m) { return m->elements == r.elements; });
    if (same == meshes.end())
      meshes.push_back(&r);
    else if (r.step_s < (*same)->step_s)
      *same = &r;
  }
  std::sort(meshes.begin(), meshes.end(), [](auto* a, auto* b) { return a->elements > b->elements; });
  std::vector<double> band;
  for (std::size_t q = 0; q < ref.values.size(); ++q) {
    double step = 0, mesh = 0;
    for (const NumericalRun* r : {longer, other})
      if (r) step = std::max(step, std::abs(r->values[q] - ref.values[q]));
    if (!meshes.empty()) {
      const double last = std::abs(meshes[0]->values[q] - ref.values[q]);
      const double ratio = static_cast<double>(ref.elements) / meshes[0]->elements;
      double order = 1;
      // From three meshes, if they are spaced evenly; else first order.
      if (meshes.size() > 1 && last > 0 &&
          std::abs(std::log(static_cast<double>(meshes[0]->elements) / meshes[1]->elements) / std::log(ratio) - 1) <
              0.1)
        order = std::clamp(std::log(std::abs(meshes[1]->values[q] - meshes[0]->values[q]) / last) / std::log(ratio),
                           0.5, 2.0);
      mesh = last / (std::pow(ratio, order) - 1);
    }
    band.push_back(step + mesh);
  }
  return band;
}

std::optional<double> observed_order(const std::vector<double>& sizes, const std::vector<double>& errors) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (!(errors[i] > 0)) continue;
    const double a = std::log(sizes[i]), b = std::log(errors[i]);
    n += 1, x += a, y += b, xx += a * a, xy += a * b;
  }
  if (n < 2 || n * xx - x * x <= 0) return {};
  return (n * xy - x * y) / (n * xx - x * x);
}

}  // namespace beltlife
