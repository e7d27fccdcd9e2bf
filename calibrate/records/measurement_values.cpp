// What is compared: see measurement_values.h.
#include "calibrate/records/measurement_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/eval/quantity_unit.h"
#include "sim/signal/bands.h"

namespace beltlife {
namespace {

constexpr double clear_of_noise = 4, share_of_largest = 0.01, clear_band = 2;

double square(double x) { return x * x; }

}  // namespace

std::string orders_text(const std::vector<double>& orders) {
  std::vector<std::string> words;
  for (const double order : orders) words.push_back(fmt::format("{:g}", order));
  return joined(words);
}

void choose_values(Measurement& m, const Reduction& r, FileProblems& problems) {
  const SpectrumSpec& spec = m.spec;
  const std::string prefix = spec.range + "." + spec.channel + ".", unit = unit_of_name(spec.channel);
  if (r.orders.empty())
    return problems.add(0,
                        "gives no orders: a window holds fewer than two of its crank revolutions, or too few samples",
                        "a longer profile.evaluate_s, or a higher solver.sample_rate_hz");
  double largest = 0;
  for (const ReducedOrder& o : r.orders) largest = std::max(largest, o.amplitude);
  const double floor = spec.floor.value_or(r.noise > 0 ? r.noise : 1e-9 * largest);
  const double known = square(spec.sigma) + square(spec.model_error);

  for (const double order : default_orders()) {
    const bool asked = std::find(spec.orders.begin(), spec.orders.end(), order) != spec.orders.end();
    if (!spec.orders.empty() && !asked) continue;
    const std::string name = fmt::format("order {:g}", order);
    const auto found =
        std::find_if(r.orders.begin(), r.orders.end(), [&](const ReducedOrder& o) { return o.order == order; });
    if (found == r.orders.end()) {
      const std::string what = fmt::format("{} ({:.4g} Hz) is beyond the sampling", name, order * r.crank_hz);
      if (asked)
        problems.add(0, what, "orders below half the sampling rates of record and simulation");
      else
        m.left_out.push_back(what);
      continue;
    }
    const double amplitude = found->amplitude;
    if (!asked && !(amplitude > clear_of_noise * r.noise)) {
      m.left_out.push_back(fmt::format("{}: {:.3g} {} is not {:g} times the noise of {:.3g} {}", name, amplitude, unit,
                                       clear_of_noise, r.noise, unit));
    } else if (!asked && !(amplitude > share_of_largest * largest)) {
      m.left_out.push_back(
          fmt::format("{}: {:.3g} {} is below {:g} of the largest", name, amplitude, unit, share_of_largest));
    } else if (!(amplitude + floor > 0)) {
      problems.add(0, name + " has an amplitude of 0, which has no logarithm", "a `floor`, or without this order");
    } else {
      // The simulation evaluates one window: an order that swells and fades by more than the noise meets it at any of
      // its amplitudes.
      const double by_noise = r.windows * square(r.noise);
      const double swell = square(found->scatter) > 4 * by_noise ? square(found->scatter) - by_noise : 0;
      const double sigma = std::sqrt(known + (square(r.noise) + swell) / square(amplitude + floor));
      m.values.push_back({fmt::format("{}order_{:g}", prefix, order), amplitude, sigma, floor, true});
    }
  }
  if (spec.mean) {
    // The mean of N samples scatters by 1 / sqrt 2 of what an amplitude does.
    const double sigma = std::hypot(spec.mean_sigma * r.mean, r.noise / std::sqrt(2.0));
    if (sigma > 0)
      m.values.push_back({prefix + "mean", r.mean, sigma, 0, false});
    else
      problems.add(0, "has a mean of 0, of which no relative deviation can be taken", "mean = false");
  }
  for (std::size_t b = 0; spec.bands && b < octave_bands.size(); ++b) {
    const Band& band = octave_bands[b];
    const std::string name = fmt::format("band {:g} to {:g} Hz", band.low_hz, band.high_hz);
    if (std::isnan(r.bands[b])) {
      m.left_out.push_back(
          name + (m.windows ? ": the sampling cannot tell it" : ": orders lie in it, or it is not in the spectrum"));
      continue;
    }
    const double power = square(r.bands[b]) - square(r.band_noise[b]);
    if (!(power > square(clear_band * r.band_noise[b])) || !(power > 0)) {
      m.left_out.push_back(fmt::format("{}: less than {:g} times its noise of {:.3g} {} remains", name, clear_band,
                                       r.band_noise[b], unit));
      continue;
    }
    m.values.push_back(
        {prefix + band_name(band), std::sqrt(power), std::hypot(spec.band_sigma, spec.model_error), floor, true});
  }
  if (m.values.empty() && problems.empty())
    problems.add(0, "holds nothing to compare: " + joined(m.left_out, "; "), "a record with orders above its noise");
}

}  // namespace beltlife
