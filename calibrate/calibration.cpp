// The calibration's problem: parameters, targets and their checks; see calibration.h.
#include "calibrate/calibration.h"

#include <fmt/format.h>

#include <algorithm>

#include "results/journal/file_checksum.h"
#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

SpecPath at(const char* list, std::size_t i, const char* key) { return SpecPath{}.child(list).element(i).child(key); }

ParameterSpec tuned(const char* path, double lower, double upper, bool log) {
  ParameterSpec p;
  p.path = path;
  p.lower = lower;
  p.upper = upper;
  p.log = log;
  return p;
}

/// What the thesis tuned by hand (section 4.1).
std::vector<ParameterSpec> tuned_set(const SceneSpec& scene) {
  std::vector<ParameterSpec> all{tuned("belt.axial_damping_n_s", 1, 50, true),
                                 tuned("belt.bending_damping_n_m2_s", 1e-6, 1e-3, true),
                                 tuned("belt.friction_front", 0.2, 1.2, true)};
  if (scene.tensioner) {
    all.push_back(tuned("tensioner.friction_torque_n_m", 0.5, 10, true));
    all.push_back(tuned("tensioner.damping_n_m_s_per_rad", 0, 5, false));  // may be 0, which has no logarithm
  }
  return all;
}

}  // namespace

void Calibration::prepare(Spec& spec, const DriverOptions&, ReadLog& log) {
  if (spec.problem.parameter.empty() && spec.problem.scene && !log.is_faulty("parameter") && !log.is_faulty("scene")) {
    try {
      const auto path = std::filesystem::path(log.file).parent_path() / *spec.problem.scene;
      spec.problem.parameter = tuned_set(read_scene(path).scene);
    } catch (const BadInput&) {
      // The scene's own problems are told where it is loaded.
    }
  }
  if (!log.problems.empty()) return;
  if (spec.problem.parameter.empty())
    log.add(SpecPath{}.child("parameter"), 0, "missing: nothing is to be fitted", "at least one [[parameter]]");
  if (spec.problem.command) {
    if (!spec.spectrum.empty())
      log.add(at("spectrum", 0, "file"), log.line("spectrum"), "a command has no operating ranges",
              "[[observation]], one a number");
    for (const ObservationSpec& o : spec.observation)
      if (std::find(spec.problem.quantities.begin(), spec.problem.quantities.end(), o.quantity) ==
          spec.problem.quantities.end())
        spec.problem.quantities.push_back(o.quantity);
  }
}

Calibration::Calibration(const LoadedProblem& problem, const Spec& spec, ReadLog& log)
    : problem_(problem), settings_(spec.calibration) {
  for (std::size_t i = 0; i < problem.spec.parameter.size(); ++i)
    if (!problem.spec.parameter[i].start)
      log.add(at("parameter", i, "start"), log.line(at("parameter", i, "path").place),
              "missing: the fit needs a place to begin", "a number, or both bounds");
  add_observations(spec, log);
  add_spectra(spec, log);
  if (!log.problems.empty()) return;
  if (targets_.size() <= problem.spec.parameter.size())
    log.add(SpecPath{}.child(spec.spectrum.empty() ? "observation" : "spectrum"), 0,
            fmt::format("{} measured numbers cannot settle {} parameters and an error", targets_.size(),
                        problem.spec.parameter.size()),
            fmt::format("at least {}", problem.spec.parameter.size() + 1));
}

void Calibration::add(Target target) {
  auto& names = problem_.spec.quantities;
  const auto found = std::find(names.begin(), names.end(), target.quantity);
  target.column = static_cast<std::size_t>(found - names.begin());
  if (found == names.end()) names.push_back(target.quantity);
  targets_.push_back(std::move(target));
}

void Calibration::add_observations(const Spec& spec, ReadLog& log) {
  std::vector<std::string> known;
  if (problem_.scene) known = quantity_names(problem_.scene->model);
  for (std::size_t i = 0; i < spec.observation.size(); ++i) {
    const ObservationSpec& o = spec.observation[i];
    if (problem_.scene && std::find(known.begin(), known.end(), o.quantity) == known.end()) {
      const SpecPath path = at("observation", i, "quantity");
      log.add(path, log.line(path.place),
              fmt::format("no quantity '{}'{}", o.quantity, did_you_mean(o.quantity, known)),
              "the names that beltlife check --json lists");
      continue;
    }
    Target t;
    t.quantity = o.quantity;
    t.value = o.value;
    t.sigma = o.sigma;
    t.floor = o.floor;
    t.logarithm = o.log;
    t.weight = o.weight;
    t.loss = settings_.loss.value_or(Loss::none);
    if (t.logarithm && !(t.value + t.floor > 0)) {
      const SpecPath path = at("observation", i, "value");
      log.add(path, log.line(path.place), fmt::format("{} has no logarithm", t.value + t.floor),
              "above 0, with log = true");
      continue;
    }
    add(std::move(t));
  }
}

void Calibration::add_spectra(const Spec& spec, ReadLog& log) {
  if (!problem_.scene) return;
  for (std::size_t i = 0; i < spec.spectrum.size(); ++i) {
    const std::size_t before = log.problems.size();
    Measurement m = read_measurement(spec.spectrum[i], problem_.scene->file.scene, problem_.folder,
                                     SpecPath{}.child("spectrum").element(i), log);
    if (log.problems.size() > before) continue;
    for (const MeasuredValue& v : m.values)
      add({v.quantity, 0, v.value, v.sigma, v.floor, v.logarithm, spec.spectrum[i].weight,
           settings_.loss.value_or(Loss::huber)});
    files_ +=
        fmt::format("# {} holds {}\n", spec.spectrum[i].file, checksum_of(problem_.folder / spec.spectrum[i].file));
    measurements_.push_back(std::move(m));
  }
}

StudyHead Calibration::head() const {
  StudyHead head;
  head.lanes = "drives";
  head.parameters = problem_.spec.paths();
  head.quantities = problem_.spec.quantities;
  head.study_text = files_;
  return head;
}

PointModel Calibration::model(int threads) const {
  DriveModelOptions options;
  options.threads = threads;
  return model_of(problem_, problem_.spec.paths(), problem_.spec.quantities, options);
}

}  // namespace beltlife
