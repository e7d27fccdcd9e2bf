// Reading and reducing a measurement: see measurement.h.
#include "calibrate/records/measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "calibrate/records/abscissa.h"
#include "calibrate/records/measurement_values.h"
#include "calibrate/records/spectrum_reduction.h"
#include "sim/model.h"

namespace beltlife {
namespace {

/// Why the study file's own words cannot be followed on this scene. True if they can.
bool check_spec(const SpectrumSpec& spec, const SceneSpec& scene, const SpecPath& at, ReadLog& log) {
  const std::size_t before = log.problems.size();
  const auto refuse = [&](const char* field, std::string what, std::string allowed) {
    const SpecPath path = at.child(field);
    if (!log.is_faulty(path.place)) log.add(path, log.line(path.place), std::move(what), std::move(allowed));
  };
  if (!scene.output || !scene.driver) {
    refuse("channel", fmt::format("the scene has no [{}]", scene.output ? "driver" : "output"),
           "a scene with a driven crank and an output");
    return false;
  }
  const std::vector<std::string> channels{scene.output->body + ".speed_rpm", scene.output->body + ".torque_n_m"};
  const bool known_channel = std::find(channels.begin(), channels.end(), spec.channel) != channels.end();
  if (!known_channel)
    refuse("channel", "no channel '" + spec.channel + "'" + did_you_mean(spec.channel, channels), joined(channels));
  std::vector<std::string> ranges;
  for (const RangeSpec& range : scene.range) ranges.push_back(range.name);
  const auto range = std::find(ranges.begin(), ranges.end(), spec.range);
  if (range == ranges.end()) {
    refuse("range", "no range '" + spec.range + "'" + did_you_mean(spec.range, ranges), joined(ranges));
  } else {
    const double rpm = scene.range[static_cast<std::size_t>(range - ranges.begin())].crank_rpm;
    if (!(rpm * scene.profile.evaluate_s / 60 >= 2))
      refuse("range",
             fmt::format("at {:g} r/min, the {:g} s that the simulation evaluates hold less than two crank "
                         "revolutions: no orders",
                         rpm, scene.profile.evaluate_s),
             "a longer profile.evaluate_s");
    constexpr double another = 0.1;
    if (spec.crank_rpm && std::abs(*spec.crank_rpm / rpm - 1) > another)
      refuse("crank_rpm", fmt::format("{:g} r/min is not the range {} of {:g} r/min", *spec.crank_rpm, spec.range, rpm),
             "a speed within 10 % of the range's");
  }
  if (known_channel && spec.unit)
    if (const std::string fault = unit_fault(*spec.unit, spec.channel); !fault.empty())
      refuse("unit", fault, "a unit of the channel");
  const std::vector<double> orders = default_orders();
  for (std::size_t i = 0; i < spec.orders.size(); ++i) {
    const auto end = spec.orders.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::find(orders.begin(), orders.end(), spec.orders[i]) == orders.end())
      refuse("orders", fmt::format("order {:g} has no quantity", spec.orders[i]), orders_text(orders));
    else if (std::find(spec.orders.begin(), end, spec.orders[i]) != end)
      refuse("orders", fmt::format("order {:g} stands twice", spec.orders[i]), "each order once");
  }
  return log.problems.size() == before && !log.is_faulty(at.place);
}

/// Mean speed of the output body without slip; 0 where nothing says it.
double expected_rpm(const SceneSpec& scene, double crank_rpm) {
  try {
    const Model m = compile(scene);
    const int output = body_index(m, scene.output->body);
    if (output < 0 || m.driver.body < 0) return 0;
    const double of_crank = m.speed_ratio[static_cast<std::size_t>(m.driver.body)];
    return of_crank > 0 ? crank_rpm * m.speed_ratio[static_cast<std::size_t>(output)] / of_crank : 0;
  } catch (const BadInput&) {
    return 0;  // who runs the scene says why it cannot be built
  }
}

/// Signs of another range: orders that do not fit, a speed that is not this range's.
void check_range(const Measurement& m, const Reduction& r, const SceneSpec& scene, double nominal_rpm,
                 FileProblems& problems) {
  constexpr double least = 1.0 / 3, slip = 0.1;
  const std::string doubt = "is this range " + m.spec.range + "?";
  const std::string fitting = fmt::format("a record at {:g} r/min within 2 %, at a steady speed", nominal_rpm);
  if (!(r.explained >= least))
    problems.add(0,
                 fmt::format("no order of {:g} r/min stands out: all of them explain {:.0f} % of the variance; {}",
                             m.spec.crank_rpm.value_or(nominal_rpm), 100 * r.explained, doubt),
                 fitting);
  else if (r.at_edge)
    problems.add(0,
                 fmt::format("its orders fit {:.5g} r/min best, 2 % off the range's {:g}, or beyond; {}", m.crank_rpm,
                             nominal_rpm, doubt),
                 fitting + ", or crank_rpm");
  const double expected = expected_rpm(scene, m.crank_rpm);
  // A record whose mean was taken away (an AC-coupled input) says nothing.
  const bool coupled = std::abs(r.mean) < 0.01 * expected && !m.spec.mean;
  if (m.windows > 0 && m.spec.channel.ends_with(".speed_rpm") && expected > 0 && !coupled &&
      std::abs(r.mean / expected - 1) > slip)
    problems.add(0,
                 fmt::format("its mean of {:.5g} r/min is more than 10 % off the {:.5g} that {:.5g} r/min of the "
                             "driven body make; {}",
                             r.mean, expected, m.crank_rpm, doubt),
                 fitting);
}

}  // namespace

Measurement read_measurement(const SpectrumSpec& spec, const SceneSpec& scene, const std::filesystem::path& folder,
                             const SpecPath& at, ReadLog& log) {
  Measurement m;
  m.spec = spec;
  if (!check_spec(spec, scene, at, log)) return m;
  const std::filesystem::path path = folder / spec.file;
  FileProblems problems(path.string(), at.child("file").shown);
  const auto refused = [&] {
    if (problems.empty()) return false;
    log.problems.insert(log.problems.end(), problems.list().begin(), problems.list().end());
    log.faulty.insert(at.child("file").place);
    return true;
  };
  const CsvFile csv = CsvFile::read(path, problems);
  if (csv.rows() == 0 && refused()) return m;
  const MeasuredColumns columns = pick_columns(csv, spec, problems);
  if (refused()) return m;
  std::vector<double> values = csv.column(columns.value_index, problems), abscissa;
  if (columns.abscissa != Abscissa::samples) abscissa = csv.column(columns.abscissa_index, problems);
  if (refused()) return m;
  for (double& v : values) v *= columns.factor;
  for (double& x : abscissa) x *= columns.abscissa_factor;

  const auto range =
      std::find_if(scene.range.begin(), scene.range.end(), [&](const RangeSpec& r) { return r.name == spec.range; });
  ReductionSettings s{scene.solver.sample_rate_hz, scene.profile.evaluate_s, range->crank_rpm / 60, {}};
  if (spec.crank_rpm) s.crank_hz = *spec.crank_rpm / 60;
  Reduction r;
  if (columns.abscissa == Abscissa::frequency || columns.abscissa == Abscissa::order) {
    // Over orders a line stands at its order, whatever the speed was.
    if (columns.abscissa == Abscissa::order && !s.crank_hz) s.crank_hz = s.nominal_hz;
    const Spectrum spectrum = spectrum_over_hz(csv, columns, std::move(abscissa), std::move(values), spec, s, problems);
    if (refused()) return m;
    r = reduce_spectrum(spectrum, spec.window, s);
  } else {
    const double rate = record_rate(csv, columns, abscissa, spec, s, problems);
    if (refused()) return m;
    r = reduce_record(values, rate, s);
  }
  m.crank_rpm = 60 * r.crank_hz;
  m.noise = r.noise;
  m.windows = r.windows;
  m.frequency_hz = r.spectrum.frequency_hz;
  m.amplitude = r.spectrum.amplitude;
  m.angle_deg = r.angle_deg;
  m.trace = r.trace;
  check_range(m, r, scene, range->crank_rpm, problems);
  if (refused()) return m;
  choose_values(m, r, problems);
  refused();
  return m;
}

}  // namespace beltlife
