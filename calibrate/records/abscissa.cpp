// What values stand over: see abscissa.h.
#include "calibrate/records/abscissa.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "calibrate/records/resample.h"
#include "calibrate/records/spectrum_reduction.h"

namespace beltlife {
namespace {

double median_step(const std::vector<double>& x) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < x.size(); ++i) steps.push_back(x[i] - x[i - 1]);
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

/// Step of an abscissa; problems with their lines where it does not increase, has gaps or is uneven.
double even_step(const CsvFile& csv, const std::vector<double>& x, const std::string& name, FileProblems& problems) {
  constexpr double gap = 1.5;      // of the median step: one sample is missing at twice of it
  constexpr double uneven = 0.75;  // steps from the even grid: what digits too few make of it is half a step
  const std::size_t before = problems.list().size();
  for (std::size_t i = 1; i < x.size(); ++i)
    if (!(x[i] > x[i - 1]))
      problems.add(csv.line(i), fmt::format("{} {:g} does not come after {:g}", name, x[i], x[i - 1]),
                   "increasing values, with digits enough to tell them apart");
  if (problems.list().size() > before || x.size() < 2) return 0;
  const double median = median_step(x);
  for (std::size_t i = 1; i < x.size(); ++i)
    if (x[i] - x[i - 1] > gap * median)
      problems.add(
          csv.line(i),
          fmt::format("a gap: {} goes from {:g} to {:g}, the usual step is {:g}", name, x[i - 1], x[i], median),
          "steps of at most 1.5 times the usual one");
  if (problems.list().size() > before) return 0;
  const double step = (x.back() - x.front()) / static_cast<double>(x.size() - 1);
  for (std::size_t i = 0; i < x.size(); ++i)
    if (std::abs(x[i] - x.front() - static_cast<double>(i) * step) > uneven * step) {
      problems.add(csv.line(i),
                   fmt::format("{} is not evenly spaced: {:g} stands where {:g} should", name, x[i],
                               x.front() + static_cast<double>(i) * step),
                   "evenly spaced values");
      return 0;
    }
  return step;
}

}  // namespace

double record_rate(const CsvFile& csv, const MeasuredColumns& columns, const std::vector<double>& abscissa,
                   const SpectrumSpec& spec, const ReductionSettings& s, FileProblems& problems) {
  if (columns.abscissa == Abscissa::samples && !spec.sample_rate_hz) {
    problems.add(csv.header_line(), "has no column of time, and no sample_rate_hz is given",
                 "a column time_s, t_s or time_ms, or sample_rate_hz; of a spectrum frequency_hz or order");
    return 0;
  }
  double rate = spec.sample_rate_hz.value_or(0);
  if (columns.abscissa == Abscissa::time) {
    const double step = even_step(csv, abscissa, "time (s)", problems);
    if (!problems.empty()) return 0;
    const double seen = step > 0 ? 1 / step : 0;
    constexpr double differs = 0.01;
    if (spec.sample_rate_hz && seen > 0 && std::abs(rate / seen - 1) > differs)
      problems.add(csv.header_line(), fmt::format("its times make {:.6g} Hz, sample_rate_hz is {:.6g}", seen, rate),
                   "sample_rate_hz only without a column of time");
    rate = seen;
    if (csv.rows() < 2) problems.add(csv.header_line(), "holds one sample", "a record");
  }
  const double highest = spec.orders.empty() ? 0 : *std::max_element(spec.orders.begin(), spec.orders.end());
  const double needed = 2 * highest * s.crank_hz.value_or(s.nominal_hz);
  const double slower = std::min(rate, s.sample_rate_hz);
  if (rate > 0 && (slower <= needed || slower <= 2 * s.nominal_hz))
    problems.add(0,
                 fmt::format("{} at {:.6g} Hz, too slowly for order {:g}: above {:.6g} Hz is needed",
                             rate <= s.sample_rate_hz ? "is sampled" : "is compared with a simulation sampled", slower,
                             std::max(highest, 1.0), std::max(needed, 2 * s.nominal_hz)),
                 "a rate above twice the highest order's frequency");
  const double seconds = rate > 0 ? static_cast<double>(csv.rows()) / rate : 0;
  const double least = static_cast<double>(window_samples(s)) / s.sample_rate_hz;
  if (rate > 0 && resampled_size(csv.rows(), rate, s.sample_rate_hz) < window_samples(s))
    problems.add(
        0, fmt::format("is {:.4g} s long, the simulation evaluates {:.4g} s (profile.evaluate_s)", seconds, least),
        fmt::format("at least {:.4g} s", least));
  return problems.empty() ? rate : 0;
}

Spectrum spectrum_over_hz(const CsvFile& csv, const MeasuredColumns& columns, std::vector<double> abscissa,
                          std::vector<double> values, const SpectrumSpec& spec, const ReductionSettings& s,
                          FileProblems& problems) {
  if (spec.mean) problems.add(csv.header_line(), "is a spectrum, which has no mean", "mean = false");
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i] < 0) problems.add(csv.line(i), fmt::format("an amplitude of {:g}", values[i]), "amplitudes from 0");
  const double scale = columns.abscissa == Abscissa::order ? s.crank_hz.value_or(s.nominal_hz) : 1;
  const bool over_orders = columns.abscissa == Abscissa::order;
  const double bin = scale * even_step(csv, abscissa, over_orders ? "order" : "frequency (Hz)", problems);
  for (double& x : abscissa) x *= scale;
  if (!problems.empty()) return {};
  constexpr std::size_t fewest = 8;
  const double clear = 2 * line_shape(spec.window).reach + 1;  // bins from a line to where the next one's are its own
  const double half_order = 0.5 * s.crank_hz.value_or(s.nominal_hz);
  if (values.size() < fewest)
    problems.add(0, fmt::format("holds {} lines", values.size()), fmt::format("at least {}", fewest));
  else if (clear * bin > half_order * (1 + 1e-6))
    problems.add(0,
                 fmt::format("a resolution of {:.4g} Hz is too coarse: orders lie {:.4g} Hz apart, and each spreads "
                             "over {:g} lines with the window {}",
                             bin, half_order, clear, enum_name(spec.window)),
                 fmt::format("at most {:.4g} Hz", half_order / clear));
  return {std::move(abscissa), std::move(values)};
}

}  // namespace beltlife
