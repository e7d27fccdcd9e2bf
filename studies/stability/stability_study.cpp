// The study of kind stability: see stability_study.h.
#include "studies/stability/stability_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "results/text/table.h"
#include "sim/run.h"

namespace beltlife {
namespace {

// A point is a case by its settings, scheme and step (no text: the predicted one).
const std::vector<std::string> columns{std::string(settings_column), "solver.scheme", "solver.step_s"};

std::string joined_lines(const std::vector<std::string>& settings) {
  std::string lines;
  for (const std::string& s : settings) lines += (lines.empty() ? "" : "\n") + s;
  return lines;
}

// Of a divergence: when and where. What limits the step has a column of its own.
std::string shortened(const std::string& why) { return why.substr(0, why.find(": step ")); }

struct Bisection {
  std::size_t case_index = 0;
  std::string scheme;
  double predicted = 0;
  std::string limited_by;
  double stable = 0, unstable = 0;  ///< bounds; 0: not found yet
  double residual = 0;              ///< at the longest stable step
  std::string why;                  ///< of the shortest unstable one
  bool done = false;
  /// Takes a trial with this step: its answer, of which more than `largest_residual` counts as unstable.
  void take(double tried, const Answer& a, double largest_residual) {
    if (a.state == PointState::infeasible || a.state == PointState::timed_out) {
      done = true;
      why = a.reason;
      return;
    }
    if (a.ok() && std::abs(a.values[0]) <= largest_residual) {
      stable = tried;
      residual = a.values[0];
    } else {
      unstable = tried;
      why = a.ok() ? fmt::format("{:.0f} % of the energy not accounted for", 100 * std::abs(a.values[0])) : a.reason;
    }
  }

  void end_if_near(double resolution, double longest) {
    done = done || (stable > 0 && unstable > 0 && unstable <= stable * (1 + resolution)) ||
           (unstable == 0 && stable * 2 > longest * predicted) || (stable == 0 && unstable < predicted / longest);
  }

  double next() const {
    if (stable == 0 && unstable == 0) return predicted;
    if (unstable == 0) return 2 * stable;
    if (stable == 0) return 0.5 * unstable;
    return std::sqrt(stable * unstable);
  }
};

}  // namespace

void StabilitySettings::check(ReadLog& log) const {
  for (std::size_t i = 0; i < variation.size(); ++i)
    if (variation[i].values.empty() && variation[i].factors.empty()) {
      const auto at = SpecPath{}.child("study").child("variation").element(i);
      if (!log.is_faulty(at.place)) log.add(at, log.line(at.place), "has neither values nor factors", "at least one");
    }
}

StabilityStudy::StabilityStudy(const LoadedProblem& problem, const StabilitySettings& settings, ReadLog& log)
    : problem_(problem), settings_(settings) {
  const SpecPath study = SpecPath{}.child("study");
  if (!problem.scene) {
    log.add(SpecPath{}.child("scene"), log.line("scene"), "missing: steps are those of the embedded simulator",
            "a scene");
    return;
  }
  if (!problem.spec.quantities.empty())
    log.add(SpecPath{}.child("quantities"), log.line("quantities"), "this kind of study records its own",
            "no quantities");
  if (!problem.spec.parameter.empty())
    log.add(SpecPath{}.child("parameter"), log.line("parameter[0]"), "this kind of study has none",
            "[[study.variation]], [[study.extreme]]");
  const SceneSpec& scene = problem.scene->file.scene;
  std::vector<std::string> known;
  for (const RangeSpec& r : scene.range) known.push_back(r.name);
  range_ = settings.range.empty() && !known.empty() ? known.front() : settings.range;
  if (std::find(known.begin(), known.end(), range_) == known.end())
    log.add(study.child("range"), log.line("study.range"), "no range '" + range_ + "'" + did_you_mean(range_, known),
            joined(known));
  cases_.push_back({"as the scene", "", {}});
  for (std::size_t i = 0; i < settings.variation.size(); ++i) {
    const VariationSpec& v = settings.variation[i];
    const SpecPath at = study.child("variation").element(i).child("path");
    try {
      const double own = get_number(scene, v.path);
      std::vector<double> values = v.values;
      for (const double f : v.factors) values.push_back(f * own);
      std::sort(values.begin(), values.end());
      for (const double x : values) {
        SceneSpec trial = scene;
        set_number(trial, v.path, x);
        cases_.push_back({v.path, fmt::format("{:g}", x), {fmt::format("{}={}", v.path, x)}});
      }
    } catch (const BadInput& bad) {
      const Problem& p = bad.problems().front();
      log.add(at, log.line(at.place), p.key + ": " + p.what, p.allowed);
    }
  }
  for (std::size_t i = 0; i < settings.extreme.size(); ++i) {
    const ExtremeSpec& e = settings.extreme[i];
    try {
      SceneSpec trial = scene;
      for (const std::string& s : e.set) set_field(trial, s);
      extremes_.push_back({e.name, "", e.set});
    } catch (const BadInput& bad) {
      const SpecPath at = study.child("extreme").element(i).child("set");
      const Problem& p = bad.problems().front();
      log.add(at, log.line(at.place), p.key + ": " + p.what, p.allowed);
    }
  }
}

StudyHead StabilityStudy::head() const {
  StudyHead head;
  head.lanes = "arcs";
  head.parameters = columns;
  for (const char* name : {"energy_residual", "drift"}) head.quantities.push_back(range_ + "." + name);
  return head;
}

Point StabilityStudy::point(const Case& c, bool trial, std::string_view scheme, const std::string& step_s) const {
  std::vector<std::string> settings;
  if (trial)  // first, so that a case may change them
    settings.insert(
        settings.end(),
        {fmt::format("profile.settle_s={}", settings_.settle_s), fmt::format("profile.ramp_s={}", settings_.ramp_s),
         fmt::format("profile.hold_s={}", settings_.hold_s), fmt::format("profile.evaluate_s={}", settings_.hold_s),
         "profile.settled_within="});
  settings.insert(settings.end(), c.settings.begin(), c.settings.end());
  return {joined_lines(settings), std::string(scheme), step_s};
}

Model StabilityStudy::drive_at(const Point& p) const {
  const SceneSpec scene = scene_at(problem_.scene->file.scene, columns, p);
  for (const RangeSpec& r : scene.range)
    if (r.name == range_) return compile(scene, r.condition);
  return compile(scene);
}

PointModel StabilityStudy::model(int threads) const {
  return model_of(problem_, columns, head().quantities, {.threads = threads, .use = LaneUse::arcs, .retry = false});
}

std::vector<StableStep> StabilityStudy::bisect(StudyRun& run) const {
  std::vector<Bisection> all;
  for (std::size_t i = 0; i < cases_.size(); ++i)
    for (const Scheme scheme : settings_.schemes) {
      Bisection b;
      b.case_index = i;
      b.scheme = enum_name(scheme);
      try {
        const Model model = drive_at(point(cases_[i], true, b.scheme, ""));
        b.predicted = stable_step(model, scheme);
        b.limited_by = step_limits(model, scheme).front().name;
      } catch (const BadInput& bad) {
        b.done = true;
        b.why = "refused: " + bad.problems().front().what;
      }
      all.push_back(b);
    }
  for (int round = 1; std::any_of(all.begin(), all.end(), [](const auto& b) { return !b.done; }); ++round) {
    std::vector<Point> points;
    std::vector<std::size_t> which;
    std::vector<double> tried;
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (all[k].done) continue;
      which.push_back(k);
      tried.push_back(all[k].next());
      points.push_back(point(cases_[all[k].case_index], true, all[k].scheme, fmt::format("{}", tried.back())));
    }
    const std::vector<Answer> answers = run.evaluate(points, fmt::format("bisection, round {}", round));
    for (std::size_t j = 0; j < which.size(); ++j) {
      all[which[j]].take(tried[j], answers[j], settings_.largest_residual);
      all[which[j]].end_if_near(settings_.resolution, settings_.longest);
    }
  }
  std::vector<StableStep> rows;
  for (const Bisection& b : all)
    rows.push_back({cases_[b.case_index].name, cases_[b.case_index].value, b.scheme, b.predicted, b.limited_by,
                    b.stable, b.unstable, b.predicted > 0 ? b.stable / b.predicted : 0, b.residual, b.why});
  return rows;
}

std::vector<ExtremeCase> StabilityStudy::extremes(StudyRun& run) const {
  std::vector<Point> points;
  for (const Case& c : extremes_) {
    SceneSpec scene = problem_.scene->file.scene;  // a case may bring its own scheme and step
    for (const std::string& s : c.settings) set_field(scene, s);
    const auto step = scene.solver.step_s;
    points.push_back(point(c, false, enum_name(scene.solver.scheme), step ? fmt::format("{}", *step) : ""));
  }
  const std::vector<Answer> answers = run.evaluate(points, "extreme cases");
  std::vector<ExtremeCase> rows;
  for (std::size_t i = 0; i < extremes_.size(); ++i) {
    ExtremeCase row{extremes_[i].name, joined_lines(extremes_[i].settings)};
    try {
      row.step_s = run_step(drive_at(points[i]));
    } catch (const BadInput&) {
      // The answer says what was wrong.
    }
    row.state = to_string(answers[i].state);
    row.reason = answers[i].reason;
    if (answers[i].ok()) {
      row.residual = answers[i].values[0];
      row.drift = answers[i].values[1];
    }
    row.processor_s = answers[i].processor_s;
    rows.push_back(std::move(row));
  }
  return rows;
}

StabilityAnswer StabilityStudy::solve(StudyRun& run) const {
  StabilityAnswer answer;
  answer.range = range_;
  answer.extremes = extremes(run);
  answer.steps = bisect(run);
  return answer;
}

std::string StabilityStudy::text(const StabilityAnswer& answer) {
  const auto seconds = [](double s) { return s > 0 ? fmt::format("{:.3g}", s) : std::string("-"); };
  const auto percent = [](double share) { return fmt::format("{:.2g}", 100 * share); };
  Table steps(
      {"case", "value", "scheme", "predicted s", "observed s", "ratio", "residual %", "limited by", "beyond it"});
  for (const StableStep& r : answer.steps)
    steps.row({r.name, r.value, r.scheme, seconds(r.predicted_s), seconds(r.observed_s),
               seconds(r.observed_over_predicted), percent(r.residual), r.limited_by, shortened(r.why)});
  Table cases({"case", "step s", "ended", "residual %", "drift %", "processor s", "reason"});
  for (const ExtremeCase& r : answer.extremes)
    cases.row({r.name, seconds(r.step_s), r.state, percent(r.residual), percent(r.drift),
               fmt::format("{:.2g}", r.processor_s), r.reason});
  std::string words;
  if (!answer.steps.empty())
    words += "Longest stable step, predicted and observed, range " + answer.range + "\n\n" + steps.text() + "\n";
  if (!answer.extremes.empty()) words += "Extreme cases, run as scenes are\n\n" + cases.text() + "\n";
  return words;
}

}  // namespace beltlife
