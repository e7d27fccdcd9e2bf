// Curves for the page: see pictures.h.
#include "calibrate/pictures.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <span>

#include "sim/eval/run_ranges.h"
#include "sim/signal/spectrum.h"

namespace beltlife {
namespace {

/// Mean over two crank revolutions, at as many places as the measurement has, deviation from the mean.
std::vector<double> revolution(std::span<const double> signal, std::span<const double> angle, std::size_t places) {
  std::vector<double> sum(places, 0), count(places, 0);
  double mean = 0;
  for (const double v : signal) mean += v / static_cast<double>(signal.size());
  constexpr double turn = 4 * std::numbers::pi;
  for (std::size_t i = 0; i < signal.size(); ++i) {
    const double share = angle[i] / turn;
    const auto k = static_cast<std::size_t>((share - std::floor(share)) * static_cast<double>(places)) % places;
    sum[k] += signal[i] - mean;
    count[k] += 1;
  }
  std::vector<std::size_t> met;
  for (std::size_t k = 0; k < places; ++k)
    if (count[k] > 0) {
      sum[k] /= count[k];
      met.push_back(k);
    }
  // Where no sample fell: a straight line between those on either side, round the circle.
  for (std::size_t m = 0; m < met.size(); ++m) {
    const std::size_t from = met[m], to = met[(m + 1) % met.size()], gap = (to + places - from) % places;
    for (std::size_t j = 1; j < gap; ++j)
      sum[(from + j) % places] = sum[from] + (sum[to] - sum[from]) * static_cast<double>(j) / static_cast<double>(gap);
  }
  return sum;
}

CalculatedCurves curves_of(const RunRecord& record, const Measurement& m, double sample_rate_hz) {
  const WindowRecord& window = record.windows.back();
  const auto stretch = [&](const std::string& name) -> std::span<const double> {
    const Channel* channel = record.trace.find(name);
    return channel ? std::span(channel->values).subspan(window.first_sample, window.last_sample - window.first_sample)
                   : std::span<const double>{};
  };
  const auto signal = stretch(m.spec.channel), angle = stretch("driver.angle_rad");
  CalculatedCurves c;
  if (signal.size() < 8) return c;
  Spectrum s = amplitude_spectrum(signal, sample_rate_hz);
  c.frequency_hz = std::move(s.frequency_hz);
  c.amplitude = std::move(s.amplitude);
  if (!m.trace.empty() && angle.size() == signal.size()) c.trace = revolution(signal, angle, m.trace.size());
  return c;
}

}  // namespace

std::vector<double> aligned(const std::vector<double>& a, std::vector<double> b) {
  if (a.size() != b.size() || a.empty()) return b;
  std::size_t best = 0;
  double highest = -1;
  for (std::size_t shift = 0; shift < b.size(); ++shift) {
    double product = 0;
    for (std::size_t i = 0; i < a.size(); ++i) product += a[i] * b[(i + shift) % b.size()];
    if (shift == 0 || product > highest) {
      highest = product;
      best = shift;
    }
  }
  std::rotate(b.begin(), b.begin() + static_cast<std::ptrdiff_t>(best), b.end());
  return b;
}

std::vector<RecordPicture> pictures_of(const LoadedProblem& problem, const std::vector<Measurement>& measurements,
                                       const Point& start, const Point& end, int threads) {
  std::vector<RecordPicture> pictures;
  if (measurements.empty()) return pictures;
  std::vector<std::string> ranges;
  for (const Measurement& m : measurements)
    if (std::find(ranges.begin(), ranges.end(), m.spec.range) == ranges.end()) ranges.push_back(m.spec.range);
  for (const Measurement& m : measurements)
    pictures.push_back({m.spec.range,
                        m.spec.channel,
                        m.spec.file,
                        m.crank_rpm,
                        m.noise,
                        static_cast<std::int64_t>(m.windows),
                        m.left_out,
                        MeasuredCurves{{m.frequency_hz, m.amplitude, m.trace}, m.angle_deg},
                        {},
                        {}});
  const auto draw = [&](const Point& point, std::optional<CalculatedCurves> RecordPicture::*side) {
    const SceneSpec scene = scene_at(problem.scene->file.scene, problem.spec.paths(), point);
    const Model model = compile(scene);
    const auto plans = plans_of(scene, ranges, problem.scene->speed());
    const auto outcomes = run_plans(model, plans, threads);
    for (std::size_t k = 0; k < measurements.size(); ++k)
      for (std::size_t r = 0; r < plans.size(); ++r) {
        if (plans[r].name != measurements[k].spec.range || !outcomes[r].record.status.ok()) continue;
        CalculatedCurves c = curves_of(outcomes[r].record, measurements[k], scene.solver.sample_rate_hz);
        c.trace = aligned(measurements[k].trace, std::move(c.trace));
        pictures[k].*side = std::move(c);
      }
  };
  draw(start, &RecordPicture::start);
  draw(end, &RecordPicture::calibrated);
  return pictures;
}

}  // namespace beltlife
