// The study of kind convergence: see convergence_study.h.
#include "studies/convergence/convergence_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "results/text/table.h"
#include "sim/eval/run_ranges.h"
#include "sim/run.h"
#include "sim/schemes/scheme.h"
#include "studies/noise/noise.h"

namespace beltlife {
namespace {

const std::vector<std::string> columns{"solver.scheme", "belt.elements", "solver.step_s", "driver.phase_rad",
                                       std::string(repeat_column)};

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return v.size() % 2 ? v[v.size() / 2] : 0.5 * (v[v.size() / 2 - 1] + v[v.size() / 2]);
}

std::string name_of(const NumericalRun& r) {
  return fmt::format("{}, {} elements, {:.3g} s", r.scheme, r.elements, r.step_s);
}

/// By group: the largest error and whose it is, of the quantities that are judged.
GroupErrors by_group(const std::vector<std::string>& quantities, const std::vector<bool>& judged,
                     const std::vector<double>& errors) {
  GroupErrors groups;
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    if (!judged[q]) continue;
    GroupError& worst = groups[quantity_group(quantities[q])];
    if (worst.quantity.empty() || errors[q] > worst.error) worst = {errors[q], quantities[q]};
  }
  return groups;
}

double error_in(const GroupErrors& groups, const std::string& group) {
  const auto at = groups.find(group);
  return at == groups.end() ? 0 : at->second.error;
}

/// The cheapest setting whose error is within `bound` in `group`, in all groups if it is empty.
OrNull<CheapestSetting> cheapest(const std::vector<SettingAnswer>& settings, const std::string& group, double bound) {
  const SettingAnswer* best = nullptr;
  for (const SettingAnswer& s : settings) {
    if (!s.errors) continue;
    bool within = group.empty() ? !s.errors->empty() : s.errors->contains(group);  // else nothing of it was judged
    for (const auto& [name, worst] : *s.errors)
      within = within && ((!group.empty() && name != group) || worst.error <= bound);
    if (within && (!best || s.processor_s < best->processor_s)) best = &s;
  }
  if (!best) return {};
  return {CheapestSetting{best->name, best->processor_s}};
}

std::map<std::string, OrNull<CheapestSetting>> cheapest_by_bound(const std::vector<SettingAnswer>& settings,
                                                                 const std::string& group) {
  return {{"1 %", cheapest(settings, group, 0.01)}, {"5 %", cheapest(settings, group, 0.05)}};
}

/// Of every mesh the run with the shortest step, coarsest first.
std::vector<const NumericalRun*> finest_steps(const std::vector<NumericalRun>& runs, Scheme scheme) {
  std::vector<const NumericalRun*> meshes;
  for (const NumericalRun& r : runs) {
    if (r.scheme != enum_name(scheme) || !r.ok()) continue;
    const auto same = std::find_if(meshes.begin(), meshes.end(), [&](auto* m) { return m->elements == r.elements; });
    if (same == meshes.end())
      meshes.push_back(&r);
    else if (r.step_s < (*same)->step_s)
      *same = &r;
  }
  std::sort(meshes.begin(), meshes.end(), [](auto* a, auto* b) { return a->elements < b->elements; });
  return meshes;
}

}  // namespace

void ConvergenceSettings::check(ReadLog& log) const {
  const auto empty = [&](const char* key, bool is) {
    if (is && !log.is_faulty(std::string("study.") + key))
      log.add(SpecPath{}.child("study").child(key), log.line(std::string("study.") + key), "is empty", "at least one");
  };
  empty("schemes", schemes.empty());
  empty("elements", elements.empty());
  empty("implicit_steps_s", implicit_steps_s.empty());
  empty("explicit_factors", explicit_factors.empty());
}

std::vector<std::string> ConvergenceStudy::quantities(const Model& m) {
  std::vector<std::string> wanted;
  for (const std::string& name : quantity_names(m)) {
    const bool of_range = std::any_of(m.scene.range.begin(), m.scene.range.end(),
                                      [&](const RangeSpec& r) { return name.starts_with(r.name + "."); });
    if (of_range && quantity_group(name) != "other") wanted.push_back(name);
  }
  return wanted;
}

ConvergenceStudy::ConvergenceStudy(const LoadedProblem& problem, const ConvergenceSettings& settings, ReadLog& log)
    : problem_(problem), settings_(settings) {
  const auto place = SpecPath{}.child("study").child("ranges");
  if (!problem.scene) {
    log.add(SpecPath{}.child("scene"), log.line("scene"),
            "missing: schemes and meshes are those of the embedded simulator", "a scene");
    return;
  }
  if (!problem.spec.parameter.empty())
    log.add(SpecPath{}.child("parameter"), log.line("parameter[0]"),
            "this kind of study varies scheme, mesh and step only", "no [[parameter]]; --set changes the scene");
  std::vector<std::string> known;
  for (const RangeSpec& r : problem.scene->file.scene.range) known.push_back(r.name);
  for (const std::string& name : settings.ranges)
    if (std::find(known.begin(), known.end(), name) == known.end())
      log.add(place, log.line(place.place), "no range '" + name + "'" + did_you_mean(name, known), joined(known));
  for (const std::string& q : problem.spec.quantities) {
    const auto of = [&](const std::string& range) { return q.starts_with(range + "."); };
    if (settings.ranges.empty() || std::any_of(settings.ranges.begin(), settings.ranges.end(), of))
      quantities_.push_back(q);
  }
  if (quantities_.empty() && !log.is_faulty(place.place))
    log.add(SpecPath{}.child("quantities"), log.line("quantities"), "none is of the ranges that are run",
            "quantities of these ranges, or other study.ranges");
  const SceneSpec& scene = problem.scene->file.scene;
  for (const int n : settings.elements)
    for (const Scheme scheme : settings.schemes) {
      SceneSpec trial = scene;
      trial.belt.elements = n;
      trial.solver.scheme = scheme;
      try {
        validate(trial);
      } catch (const BadInput& bad) {
        const auto at = SpecPath{}.child("study").child("elements");
        log.add(at, log.line(at.place), bad.problems().front().what, bad.problems().front().allowed);
        break;  // one complaint a mesh
      }
    }
}

StudyHead ConvergenceStudy::head() const {
  StudyHead head;
  head.lanes = "arcs";
  head.parameters = columns;
  head.quantities = quantities_;
  return head;
}

PointModel ConvergenceStudy::model(int threads) const {
  return [=, this](const std::vector<Point>& points, const OnAnswer& on_answer) {
    // A model of its own for every batch: the simulator's memory would answer a repeat without running it.
    const DriveModelOptions options{.threads = threads, .use = LaneUse::arcs, .retry = false};
    return model_of(problem_, columns, quantities_, options)(points, on_answer);
  };
}

Point ConvergenceStudy::point_of_run(const NumericalRun& r, double phase, int repeat) const {
  return {r.scheme, static_cast<double>(r.elements), r.step_s, phase, static_cast<double>(repeat)};
}

std::vector<NumericalRun> ConvergenceStudy::settings() const {
  std::vector<NumericalRun> all;
  for (const Scheme scheme : settings_.schemes)
    for (const int n : settings_.elements) {
      SceneSpec scene = problem_.scene->file.scene;
      scene.belt.elements = n;
      scene.solver.scheme = scheme;
      scene.solver.step_s.reset();
      const Model model = compile(scene);  // a setting has one step for all ranges: that of the base condition
      const bool implicit = scheme == Scheme::linearly_implicit;
      for (const double x : implicit ? settings_.implicit_steps_s : settings_.explicit_factors) {
        Model at = model;
        at.scene.solver.step_s = implicit ? x : x * stable_step(model, scheme);
        all.push_back({std::string(enum_name(scheme)), n, run_step(at), 0, "", {}});
      }
    }
  return all;
}

std::vector<NumericalRun> ConvergenceStudy::run_all(StudyRun& run) const {
  std::vector<NumericalRun> runs = settings();
  const double phase = problem_.scene->file.scene.driver ? problem_.scene->file.scene.driver->phase_rad : 0;
  std::vector<Point> points;
  for (const NumericalRun& r : runs) points.push_back(point_of_run(r, phase, 0));
  const std::vector<Answer> first = run.evaluate(points, "convergence");
  std::vector<std::vector<double>> times(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!first[i].ok()) runs[i].failure = fmt::format("{}: {}", to_string(first[i].state), first[i].reason);
    runs[i].values = first[i].values;
    // Stated for an element of the scene's own mesh, or meshes could not be compared.
    for (std::size_t q = 0; q < runs[i].values.size(); ++q)
      if (of_one_element(quantities_[q]))
        runs[i].values[q] *= static_cast<double>(runs[i].elements) / problem_.scene->model.belt.nodes;
    times[i].push_back(first[i].processor_s);
  }
  for (int repeat = 1; repeat < settings_.repeats; ++repeat) {
    std::vector<std::size_t> which;
    points.clear();
    for (std::size_t i = 0; i < runs.size(); ++i)
      if (runs[i].ok() && first[i].processor_s < settings_.repeat_below_s) {
        which.push_back(i);
        points.push_back(point_of_run(runs[i], phase, repeat));
      }
    const std::vector<Answer> again = run.evaluate(points, fmt::format("repeat {}", repeat));
    for (std::size_t k = 0; k < which.size(); ++k) times[which[k]].push_back(again[k].processor_s);
  }
  for (std::size_t i = 0; i < runs.size(); ++i) runs[i].processor_s = median(times[i]);
  return runs;
}

std::vector<double> ConvergenceStudy::noise_floor(StudyRun& run) const {
  const Model& model = problem_.scene->model;
  NumericalRun own{std::string(enum_name(model.scene.solver.scheme)), model.belt.nodes, run_step(model), 0, "", {}};
  std::vector<Point> points;
  if (model.scene.driver)
    for (int k = 0; k < settings_.phases; ++k)
      points.push_back(
          point_of_run(own, model.scene.driver->phase_rad + 2 * std::numbers::pi * k / settings_.phases, 0));
  const std::vector<Answer> answers = run.evaluate(points, "noise floor");
  std::vector<double> floor;
  for (std::size_t q = 0; q < quantities_.size(); ++q) {
    std::vector<double> v;
    for (const Answer& a : answers)
      if (a.ok()) v.push_back(a.values[q]);
    floor.push_back(spread_of(v).standard_deviation);
  }
  return floor;
}

double ConvergenceStudy::simulated_s() const {
  const std::vector<std::string> ranges = ranges_for(problem_.scene->file.scene, quantities_);
  double simulated = 0;
  for (const RunPlan& plan : plans_of(problem_.scene->file.scene, ranges, problem_.scene->speed()))
    simulated += plan.end_s;
  return simulated;
}

std::vector<bool> ConvergenceStudy::judge(const std::vector<NumericalRun>& runs, std::size_t reference,
                                          const std::vector<double>& floor, ConvergenceAnswer& answer) const {
  const NumericalRun& best = runs[reference];
  const std::vector<double> shares = as_errors(quantities_, best.values, floor);
  std::vector<bool> judged(quantities_.size(), true);
  for (std::size_t q = 0; q < quantities_.size(); ++q) {
    judged[q] = shares[q] < 0.1;
    if (!judged[q]) answer.not_judged.push_back(quantities_[q]);
  }
  const std::vector<double> band = reference_band(runs, reference);
  answer.reference = name_of(best);
  answer.reference_band = by_group(quantities_, judged, as_errors(quantities_, best.values, band));
  answer.noise_floor = by_group(quantities_, judged, shares);
  for (std::size_t q = 0; q < quantities_.size(); ++q)
    answer.quantities[quantities_[q]] = {quantity_group(quantities_[q]), best.values[q], band[q], floor[q]};
  return judged;
}

SettingAnswer ConvergenceStudy::setting_of(const NumericalRun& r, const std::vector<NumericalRun>& runs,
                                           std::optional<std::size_t> reference, const std::vector<bool>& judged,
                                           double simulated) const {
  SettingAnswer s;
  s.name = name_of(r);
  s.scheme = r.scheme;
  s.elements = r.elements;
  s.step_s = r.step_s;
  s.steps = std::round(simulated / r.step_s);
  s.evaluations = s.steps * (r.scheme == "thesis" ? 2 : 1);
  s.processor_s = r.processor_s;
  s.simulated_s_per_s = r.processor_s > 0 ? simulated / r.processor_s : 0;
  if (!r.ok()) s.failure = r.failure;
  if (!reference || !r.ok()) return s;
  s.errors = by_group(quantities_, judged, errors_of(quantities_, runs[*reference].values, r.values));
  // The step alone: against the explicit run with the shortest step on the same mesh.
  std::vector<NumericalRun> same_mesh;
  for (const NumericalRun& other : runs)
    if (other.elements == r.elements) same_mesh.push_back(other);
  if (const auto own = reference_run(same_mesh))
    s.step_errors = by_group(quantities_, judged, errors_of(quantities_, same_mesh[*own].values, r.values));
  return s;
}

std::map<std::string, ObservedOrders> ConvergenceStudy::orders_of(const std::string& group,
                                                                  const std::vector<NumericalRun>& runs,
                                                                  const std::vector<SettingAnswer>& settings,
                                                                  const std::vector<bool>& judged) const {
  std::map<std::string, ObservedOrders> orders;
  for (const Scheme scheme : settings_.schemes) {
    std::vector<double> steps, step_errors, lengths, mesh_errors;
    for (const SettingAnswer& s : settings) {
      if (s.scheme != enum_name(scheme) || !s.errors || !s.step_errors) continue;
      if (scheme != Scheme::linearly_implicit || s.elements != problem_.scene->model.belt.nodes) continue;
      steps.push_back(s.step_s);
      step_errors.push_back(error_in(*s.step_errors, group));
    }
    // Meshes: differences of neighbouring ones at the shortest step, whose slope knows nothing of the reference.
    const std::vector<const NumericalRun*> meshes = finest_steps(runs, scheme);
    for (std::size_t i = 0; i + 1 < meshes.size(); ++i) {
      lengths.push_back(1.0 / meshes[i]->elements);
      mesh_errors.push_back(error_in(
          by_group(quantities_, judged, errors_of(quantities_, meshes[i + 1]->values, meshes[i]->values)), group));
    }
    const ObservedOrders o{observed_order(steps, step_errors), observed_order(lengths, mesh_errors)};
    if (o.step || o.mesh) orders[std::string(enum_name(scheme))] = o;
  }
  return orders;
}

ConvergenceAnswer ConvergenceStudy::solve(StudyRun& run) const {
  const std::vector<NumericalRun> runs = run_all(run);
  const std::vector<double> floor = noise_floor(run);
  ConvergenceAnswer answer;
  answer.processor = processor_name();
  for (const std::string& g : quantity_groups())
    if (std::any_of(quantities_.begin(), quantities_.end(), [&](const auto& q) { return quantity_group(q) == g; }))
      answer.groups.push_back(g);
  answer.simulated_s = simulated_s();
  const auto reference = reference_run(runs);
  std::vector<bool> judged(quantities_.size(), true);
  if (reference) judged = judge(runs, *reference, floor, answer);
  for (const NumericalRun& r : runs)
    answer.settings.push_back(setting_of(r, runs, reference, judged, answer.simulated_s));
  if (!reference) {
    answer.error = "no explicit run came to its end: there is no reference";
    return answer;
  }
  for (const std::string& group : answer.groups) {
    answer.orders[group] = orders_of(group, runs, answer.settings, judged);
    answer.cheapest[group] = cheapest_by_bound(answer.settings, group);
  }
  answer.cheapest["all"] = cheapest_by_bound(answer.settings, "");
  return answer;
}

namespace {

std::string percent(double share) { return fmt::format("{:.2g}", 100 * share); }

std::string best_text(const OrNull<CheapestSetting>& best) {
  if (!best.value) return "none of these";
  return fmt::format("{} ({:.3g} s)", best.value->setting, best.value->processor_s);
}

}  // namespace

std::string ConvergenceStudy::text(const ConvergenceAnswer& answer) {
  std::vector<std::string> header{"scheme", "elements", "step s", "processor s", "s/s"};
  header.insert(header.end(), answer.groups.begin(), answer.groups.end());
  Table table(header);
  const auto line = [&](std::vector<std::string> row, const std::optional<GroupErrors>& errors) {
    for (const std::string& g : answer.groups)
      row.push_back(errors && errors->contains(g) ? percent(errors->at(g).error) : "-");
    table.row(std::move(row));
  };
  std::string failures;
  for (const SettingAnswer& s : answer.settings) {
    line({s.scheme, fmt::format("{}", s.elements), fmt::format("{:.3g}", s.step_s),
          fmt::format("{:.3g}", s.processor_s), fmt::format("{:.3g}", s.simulated_s_per_s)},
         s.errors);
    if (s.failure) failures += s.name + ": " + *s.failure + "\n";
  }
  if (answer.error) return table.text() + "\n" + *answer.error + "\n" + failures;
  line({"reference's own band", "-", "-", "-", "-"}, answer.reference_band);
  line({"noise floor", "-", "-", "-", "-"}, answer.noise_floor);
  std::string words = fmt::format(
      "Largest error of each group of quantities, %, against {}\n(log10 life: hundredths of a decade), {:.4g} s "
      "simulated, "
      "on one thread of {}.\n\n",
      answer.reference.value_or(""), answer.simulated_s, answer.processor);
  Table cheapest({"cheapest setting within", "1 %", "5 %"});
  std::vector<std::string> rows = answer.groups;
  rows.push_back("all");
  for (const std::string& group : rows) {
    const auto& bounds = answer.cheapest.at(group);
    cheapest.row({group == "all" ? "all of them" : group, best_text(bounds.at("1 %")), best_text(bounds.at("5 %"))});
  }
  if (!answer.not_judged.empty())
    words +=
        fmt::format("Not judged, because a tenth of their value or more is noise: {}\n\n", joined(answer.not_judged));
  return words + table.text() + "\n" + cheapest.text() + (failures.empty() ? "" : "\nFailed\n" + failures);
}

}  // namespace beltlife
