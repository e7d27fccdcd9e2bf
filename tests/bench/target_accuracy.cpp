// Owns the targets of accuracy: every step's quantities and real-time factor against the thesis scheme at a short step.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>

#include "sim/eval/evaluator.h"
#include "sim/eval/quantities.h"
#include "tests/bench/target_drives.h"

namespace beltlife::bench {
namespace {

constexpr double reference_step_s = 1e-7;

// Main quantities and those of order 6, by name. The slip of the driven pulley behind itself is none.
Json quantities(const Drive& d) {
  const std::string none = range + ".pulley." + d.model.scene.driver->body + ".slip_percent";
  const WindowRecord& window = d.record.windows.front();
  Json found = Json::object();
  for (const Quantity& q : quantities_of(summarise(d.model, d.record, window))) {
    const bool counts = q.name.ends_with(".order_3") || q.name.ends_with(".order_6") ||
                        q.name.find(".tension_n.") != q.name.npos || q.name.ends_with(".slip_percent");
    if (counts && q.name != none) found[q.name] = q.value;
  }
  const auto mean = [](const std::vector<double>& v) {
    return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
  };
  for (std::size_t p = 0; p < window.passes.size(); ++p) {
    const std::string pass = range + ".pass." + d.model.body_name[p];
    found[pass + ".normal_n"] = mean(window.passes[p].normal_resolved);
    found[pass + ".tangential_n"] = mean(window.passes[p].tangential_resolved);
  }
  return found;
}

// {scheme, step_s, cpu_s, quantities, scene}; from the file if that holds the same scene. Null for a quick run.
Json reference(const Settings& settings) {
  if (settings.quick) return {};
  const SceneSpec scene = baseline(settings, Scheme::thesis, reference_step_s);
  const std::string key = simulation_key(scene, range);
  if (std::filesystem::exists(settings.reference)) {
    Json kept = Json::parse(std::ifstream(settings.reference));
    if (kept.at("scene") == key) return kept;
  }
  Drive drive(scene);
  const Cost cost = cost_of([&] { drive.run(); });
  Json made{{"scheme", enum_name(Scheme::thesis)},
            {"step_s", drive.record.step_s},
            {"cpu_s", cost.cpu_s},
            {"quantities", quantities(drive)},
            {"scene", key}};
  if (!settings.reference.empty()) std::ofstream(settings.reference) << made.dump(1) << "\n";
  return made;
}

// Errors against the reference, largest of the main ones, and of order 6.
void compare(const Json& reference, const Json& values, Json& row) {
  int main = 0, within = 0;
  double largest = 0, order_6 = 0;
  std::string where;
  Json errors = Json::object();
  for (const auto& [name, value] : reference.items()) {
    const double error = 100 * (values.at(name).get<double>() / value.get<double>() - 1);
    const double size = std::isnan(error) ? INFINITY : std::abs(error);
    errors[name] = error;
    if (name.ends_with(".order_6")) {
      order_6 = std::max(order_6, size);
      continue;
    }
    ++main;
    if (size <= 1) ++within;
    if (size > largest) {
      largest = size;
      where = name;
    }
  }
  row["largest_error_percent"] = largest;
  row["largest_error_in"] = where;
  row["within_1_percent"] = within;
  row["main_quantities"] = main;
  row["order_6_error_percent"] = order_6;
  row["errors_percent"] = errors;
}

}  // namespace

Json accuracy(const Settings& settings, Targets& targets) {
  const Json expected = reference(settings);
  std::vector<Drive> drives;
  drives.emplace_back(baseline(settings, Scheme::linearly_implicit, {}));
  const double predicted = run_step(drives.front().model);
  for (const double step : {1e-5, 1.25e-5, 2e-5, 2.5e-5, 1e-3 / 30})
    if (std::abs(step / predicted - 1) > 1e-6) drives.emplace_back(baseline(settings, Scheme::linearly_implicit, step));
  drives.emplace_back(baseline(settings, Scheme::symplectic_euler, {}));
  const std::vector<Cost> costs = costs_of(settings.quick ? 1 : 3, runs_of(drives));

  Json rows = Json::array();
  double fastest = std::nan(""), fastest_order_6 = std::nan("");
  for (std::size_t i = 0; i < drives.size(); ++i) {
    const Drive& d = drives[i];
    const double factor = d.record.simulated_s / costs[i].cpu_s;
    Json row{{"scheme", enum_name(d.model.scene.solver.scheme)},
             {"step_s", d.record.step_s},
             {"predicted_step", !d.model.scene.solver.step_s},
             {"real_time_factor_cpu", factor},
             {"real_time_factor_wall", d.record.simulated_s / costs[i].wall_s},
             {"energy_residual_percent", 100 * d.record.windows.front().energy.relative_residual()}};
    if (!expected.is_null()) {
      compare(expected["quantities"], quantities(d), row);
      if (row["within_1_percent"] == row["main_quantities"]) {
        fastest = std::fmax(fastest, factor);
        if (row["order_6_error_percent"] <= 3) fastest_order_6 = std::fmax(fastest_order_6, factor);
      }
    }
    rows.push_back(row);
  }
  if (!expected.is_null()) {  // where no step is good enough
    fastest = std::fmax(fastest, 0);
    fastest_order_6 = std::fmax(fastest_order_6, 0);
  }
  targets.add("real-time factor, main quantities within 1 %", true, 2, {}, fastest);
  targets.add("real-time factor, and order 6 within 3 %", true, 4, {}, fastest_order_6);
  Json shown = expected;
  if (!shown.is_null()) shown.erase("scene");
  return {{"reference", shown}, {"steps", rows}};
}

}  // namespace beltlife::bench
