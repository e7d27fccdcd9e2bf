// The study of kind oat: see oat_study.h.
#include "studies/oat/oat_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "results/text/table.h"
#include "studies/oat/oat.h"

namespace beltlife {
namespace {

bool ends(const std::string& name, std::string_view ending) { return name.ends_with(ending); }

bool is_life(const std::string& q) { return ends(q, "life_h"); }

std::vector<double> values_of(const std::vector<Answer>& answers, std::size_t q) {
  std::vector<double> v;
  for (const Answer& a : answers)
    if (a.ok()) v.push_back(a.values[q]);
  return v;
}

std::string signed_text(double x, int digits) { return fmt::format("{:+.{}f}", x, digits); }

/// What is seen agrees with what is said; slight changes are none to a reader of plots.
bool agrees(Verdict said, const std::string& seen, const std::string& peaks) {
  if (said == Verdict::spikes) return peaks == "increase";
  return enum_name(said) == (seen.starts_with("slight") ? "none" : seen);
}

}  // namespace

void OatSettings::check(ReadLog& log) const {
  for (std::size_t i = 0; i < change.size(); ++i)
    if (const auto at = SpecPath{}.child("study").child("change").element(i).child("set");
        change[i].set.empty() && !log.is_faulty(at.place))
      log.add(at, log.line(at.place), "is empty", "at least one setting PATH=VALUE");
}

std::vector<std::string> OatStudy::quantities(const Model& m) {
  std::vector<std::string> names;
  for (const RangeSpec& range : m.scene.range)
    if (m.scene.output)
      for (const char* what : {"speed_rpm.order_3", "torque_n_m.order_3"})
        names.push_back(fmt::format("{}.{}.{}", range.name, m.scene.output->body, what));
  names.push_back("log10_life_h");
  return names;
}

OatStudy::OatStudy(const LoadedProblem& problem, const OatSettings& settings, ReadLog& log)
    : problem_(problem), settings_(settings), columns_(problem.spec.paths()) {
  const SceneSpec* scene = problem.scene ? &problem.scene->file.scene : nullptr;
  const SpecPath study = SpecPath{}.child("study");
  const std::vector<double> start = problem.start();
  const auto refuse_setting = [&](const SpecPath& at, const std::vector<std::string>& lines) {
    if (!scene) {
      if (!lines.empty())
        log.add(at, log.line(at.place), "settings are of a scene, and there is none", "[[parameter]]");
      return;
    }
    SceneSpec trial = *scene;
    try {
      for (const std::string& line : lines) set_field(trial, line);
    } catch (const BadInput& bad) {
      const Problem& p = bad.problems().front();
      log.add(at, log.line(at.place), p.key + ": " + p.what, p.allowed);
    }
  };
  for (std::size_t i = 0; i < problem.spec.parameter.size(); ++i) {
    const ParameterSpec& p = problem.spec.parameter[i];
    for (const auto& [bound, value] : {std::pair{"lower", p.lower}, std::pair{"upper", p.upper}}) {
      if (!value) continue;
      Comparison c{
          {fmt::format("{} {:g} to {:g}", p.path, start[i], *value), {}, {}, {}, {}}, {{}, start}, {{}, start}};
      c.changed.x[i] = *value;
      comparisons_.push_back(std::move(c));
    }
    if (!p.start)
      log.add(SpecPath{}.child("parameter").element(i), log.line(fmt::format("parameter[{}]", i)),
              "has no nominal value", "start, both bounds or the mean of a distribution");
    if (!p.lower && !p.upper)
      log.add(SpecPath{}.child("parameter").element(i), log.line(fmt::format("parameter[{}]", i)),
              "has no bound to go to", "lower, upper or both");
  }
  for (std::size_t i = 0; i < settings.change.size(); ++i) {
    const ChangeSpec& change = settings.change[i];
    const auto refuse_unseen = [&](bool said, const char* says, const char* list, bool empty) {
      const SpecPath at = study.child("change").element(i).child(says);
      if (said && empty)
        log.add(at, log.line(at.place), fmt::format("there is no quantity to see it in: study.{} is empty", list), "");
    };
    const bool spikes = change.says_magnitude == Verdict::spikes;
    refuse_unseen(change.says_frequency.has_value(), "says_frequency", "frequency", settings.frequency.empty());
    refuse_unseen(spikes, "says_magnitude", "peak", settings.peak.empty());
    refuse_setting(study.child("change").element(i).child("base"), change.base);
    refuse_setting(study.child("change").element(i).child("set"), change.set);
    Comparison c{change, {change.base, start}, {change.base, start}};
    c.changed.settings.insert(c.changed.settings.end(), change.set.begin(), change.set.end());
    comparisons_.push_back(std::move(c));
  }
  if (comparisons_.empty())
    log.add(study.child("change"), log.line("study"), "missing: nothing is changed",
            "[[study.change]] or [[parameter]]");
  for (std::size_t i = 0; i < settings.variant.size(); ++i)
    refuse_setting(study.child("variant").element(i).child("set"), settings.variant[i].set);
  if (settings_.variant.empty()) settings_.variant.push_back({"as the scene", {}});
  const auto known = [&](const char* key, const std::vector<std::string>& names) {
    for (const std::string& name : names)
      if (std::find(problem.spec.quantities.begin(), problem.spec.quantities.end(), name) ==
          problem.spec.quantities.end())
        log.add(study.child(key), log.line(study.child(key).place),
                "'" + name + "' is not recorded" + did_you_mean(name, problem.spec.quantities), "one of `quantities`");
  };
  known("magnitude", settings.magnitude);
  known("frequency", settings.frequency);
  known("peak", settings.peak);
  if (settings_.magnitude.empty())
    for (const std::string& q : problem.spec.quantities)
      if (!is_life(q) &&
          std::find(settings.frequency.begin(), settings.frequency.end(), q) == settings.frequency.end() &&
          std::find(settings.peak.begin(), settings.peak.end(), q) == settings.peak.end())
        settings_.magnitude.push_back(q);
  phased_ = scene && scene->driver;
  if (scene) columns_.insert(columns_.begin(), std::string(settings_column));
  if (phased_) columns_.push_back("driver.phase_rad");
}

StudyHead OatStudy::head() const {
  StudyHead head;
  head.lanes = "drives";
  head.parameters = columns_;
  head.quantities = problem_.spec.quantities;
  return head;
}

PointModel OatStudy::model(int threads) const {
  return model_of(problem_, columns_, problem_.spec.quantities, {.threads = threads});
}

std::vector<Point> OatStudy::points_of(const Side& side, const VariantSpec& variant) const {
  std::string lines;
  for (const auto& list : {variant.set, side.settings})
    for (const std::string& s : list) lines += (lines.empty() ? "" : "\n") + s;
  std::vector<Point> points;
  for (int k = 0; k < (phased_ ? settings_.phases : 1); ++k) {
    Point p;
    if (problem_.scene) p.emplace_back(lines);
    p.insert(p.end(), side.x.begin(), side.x.end());
    if (phased_)
      p.emplace_back(problem_.scene->file.scene.driver->phase_rad + 2 * std::numbers::pi * k / settings_.phases);
    points.push_back(std::move(p));
  }
  return points;
}

namespace {

ChangeEffect effect_of(const std::string& quantity, const Effect& e) {
  ChangeEffect found;
  found.before = e.before;
  found.after = e.after;
  found.change = e.change;
  found.standard_error = e.standard_error;
  found.beyond_noise = e.beyond_noise;
  found.visible = e.visible;
  found.responses_before = static_cast<std::int64_t>(e.responses_before);
  found.responses_after = static_cast<std::int64_t>(e.responses_after);
  const double ratio = e.before != 0 ? e.after / e.before : 0;
  if (is_life(quantity))
    found.life_factor = ends(quantity, "log10_life_h") ? std::pow(10, e.after - e.before) : ratio;
  else if (ratio > 0)
    found.db = 20 * std::log10(ratio);
  return found;
}

/// Why a comparison cannot be judged; empty if both sides have a point that is ok.
std::string failure_of(const std::vector<Answer>& base, const std::vector<Answer>& changed) {
  for (const auto* side : {&base, &changed}) {
    const auto bad = std::find_if(side->begin(), side->end(), [](const Answer& a) { return !a.ok(); });
    if (bad != side->end() && values_of(*side, 0).empty())
      return fmt::format("{}: {}", to_string(bad->state), bad->reason);
  }
  return "";
}

}  // namespace

/// Verdicts from the effects, one a quantity, beside what was said.
void OatStudy::judge(const ChangeSpec& change, const std::vector<Effect>& effects, ChangeAnswer& row) const {
  const auto looked_at = [&](const std::vector<std::string>& list) {
    std::vector<Effect> of;
    for (std::size_t q = 0; q < effects.size(); ++q)
      if (std::find(list.begin(), list.end(), problem_.spec.quantities[q]) != list.end()) of.push_back(effects[q]);
    return of;
  };
  const std::vector<Effect> frequencies = looked_at(settings_.frequency), peaks = looked_at(settings_.peak);
  row.magnitude = verdict_of(looked_at(settings_.magnitude));
  const std::string spikes = verdict_of(peaks);
  if (!frequencies.empty()) row.frequency = verdict_of(frequencies);
  if (!peaks.empty()) row.peak = spikes;
  if (change.says_magnitude) {
    row.says_magnitude = enum_name(*change.says_magnitude);
    row.agrees_magnitude = agrees(*change.says_magnitude, *row.magnitude, spikes);
  }
  if (change.says_frequency) {
    row.says_frequency = enum_name(*change.says_frequency);
    row.agrees_frequency = agrees(*change.says_frequency, row.frequency.value_or(""), spikes);
  }
}

ChangeAnswer OatStudy::row_of(const Comparison& c, const std::vector<Answer>& base,
                              const std::vector<Answer>& changed) const {
  ChangeAnswer row;
  row.name = c.change.name;
  if (const std::string failure = failure_of(base, changed); !failure.empty()) {
    row.failure = failure;
    return row;
  }
  std::vector<Effect> effects;
  for (std::size_t q = 0; q < problem_.spec.quantities.size(); ++q) {
    effects.push_back(compare(values_of(base, q), values_of(changed, q), settings_.visible, settings_.standard_errors));
    row.effects[problem_.spec.quantities[q]] = effect_of(problem_.spec.quantities[q], effects.back());
  }
  judge(c.change, effects, row);
  return row;
}

OatAnswer OatStudy::solve(StudyRun& run) const {
  std::vector<Point> points;
  for (const VariantSpec& variant : settings_.variant)
    for (const Comparison& c : comparisons_)
      for (const Side* side : {&c.base, &c.changed})
        for (Point& p : points_of(*side, variant)) points.push_back(std::move(p));
  const std::vector<Answer> answers = run.evaluate(points, "one at a time");
  const std::size_t copies = points.size() / (2 * comparisons_.size() * settings_.variant.size());
  auto next = answers.begin();
  const auto take = [&] {
    std::vector<Answer> side(next, next + static_cast<std::ptrdiff_t>(copies));
    next += static_cast<std::ptrdiff_t>(copies);
    return side;
  };
  OatAnswer answer;
  answer.visible = settings_.visible;
  answer.replicates = static_cast<std::int64_t>(copies);
  bool any = false;
  for (const VariantSpec& variant : settings_.variant) {
    VariantAnswer table;
    table.name = variant.name;
    for (const Comparison& c : comparisons_) {
      const std::vector<Answer> base = take(), changed = take();
      ChangeAnswer row = row_of(c, base, changed);
      any = any || !row.effects.empty();
      for (const auto& agrees : {row.agrees_magnitude, row.agrees_frequency})
        if (agrees) ++table.said, table.agreed += *agrees;
      table.changes.push_back(std::move(row));
    }
    answer.variants.push_back(std::move(table));
  }
  if (!any) answer.error = "no comparison has an answer on both sides";
  return answer;
}

namespace {

std::string effect_text(const ChangeEffect& e) {
  std::string text = e.life_factor ? fmt::format("{:.3f}", *e.life_factor) : e.db ? signed_text(*e.db, 2) : "-";
  if (!e.beyond_noise) text += " n";
  if (e.responses_before > 1 || e.responses_after > 1) text += " c";
  return text;
}

std::vector<std::string> cells_of(const ChangeAnswer& row, bool said, std::size_t columns) {
  std::vector<std::string> cells{row.name};
  if (row.failure) {
    cells.push_back(*row.failure);
    cells.resize(columns);
    return cells;
  }
  for (const auto& [quantity, effect] : row.effects) cells.push_back(effect_text(effect));
  for (const auto& verdict : {row.magnitude, row.frequency, row.peak}) cells.push_back(verdict.value_or("-"));
  if (!said) return cells;
  std::string says, agreement;
  const auto add = [&](const std::optional<std::string>& word, const std::optional<bool>& agrees) {
    if (!word) return;
    says += (says.empty() ? "" : ", ") + *word;
    agreement += (agreement.empty() ? "" : ", ") + std::string(agrees.value_or(false) ? "yes" : "no");
  };
  add(row.says_magnitude, row.agrees_magnitude);
  add(row.says_frequency, row.agrees_frequency);
  cells.push_back(says);
  cells.push_back(agreement);
  return cells;
}

}  // namespace

std::string OatStudy::text(const OatAnswer& answer) {
  std::string words;
  for (const VariantAnswer& variant : answer.variants) {
    // Names of quantities are long: numbers stand for them in the header.
    std::vector<std::string> header{"change"};
    std::string legend;
    const auto first = std::find_if(variant.changes.begin(), variant.changes.end(),
                                    [](const ChangeAnswer& row) { return !row.effects.empty(); });
    if (first != variant.changes.end())
      for (const auto& [q, e] : first->effects) {
        legend += fmt::format("  ({}) {}, {}\n", header.size(), q, is_life(q) ? "factor on life" : "dB");
        header.push_back(fmt::format("({})", header.size()));
      }
    const bool said = variant.said > 0;
    header.insert(header.end(), {"magnitude", "frequency", "peak"});
    if (said) header.insert(header.end(), {"said", "agrees"});
    Table table(header);
    for (const ChangeAnswer& row : variant.changes) table.row(cells_of(row, said, header.size()));
    words += variant.name + "\n\n" + table.text() + legend;
    if (said) words += fmt::format("{} of {} verdicts agree\n", variant.agreed, variant.said);
    words += "\n";
  }
  return words + fmt::format(
                     "{} replicates a side; n: within the noise, c: several steady responses coexist. Changes beyond "
                     "noise but\n"
                     "below {:g} % are slight, and count as none beside what is said.\n",
                     answer.replicates, 100 * answer.visible);
}

}  // namespace beltlife
