// Natural frequencies over speed and their crossings with orders: see campbell.h.
#include "sim/modes/campbell.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "sim/signal/spectrum.h"

namespace beltlife {
namespace {

constexpr double near_share = 0.05;

std::string name_of_rotational(ArmState arm, std::size_t number) {
  return arm == ArmState::none ? fmt::format("rotational {}", number)
                               : fmt::format("rotational {}, arm {}", number, name_of(arm));
}

std::vector<FrequencyCurve> rotational_curves(const std::vector<Modes>& points, double highest_hz) {
  std::vector<FrequencyCurve> curves;
  for (std::size_t a = 0; a < points.front().arms.size(); ++a) {
    std::size_t count = points.front().arms[a].damped.size();
    for (const Modes& p : points) count = std::min(count, p.arms[a].damped.size());
    for (std::size_t k = 0; k < count; ++k) {
      const ArmState arm = points.front().arms[a].arm;
      FrequencyCurve curve{name_of_rotational(arm, k + 1), arm, {}, 0};
      curve.damping_ratio = points.front().arms[a].damped[k].damping_ratio;
      for (const Modes& p : points) {
        curve.frequency_hz.push_back(p.arms[a].damped[k].frequency_hz);
        curve.damping_ratio = std::min(curve.damping_ratio, p.arms[a].damped[k].damping_ratio);
      }
      if (*std::min_element(curve.frequency_hz.begin(), curve.frequency_hz.end()) < highest_hz)
        curves.push_back(std::move(curve));
    }
  }
  return curves;
}

std::vector<FrequencyCurve> transverse_curves(const std::vector<Modes>& points) {
  std::vector<FrequencyCurve> curves;
  for (std::size_t k = 0; k < points.front().spans.size(); ++k)
    for (int n = 0; n < 2; ++n) {
      FrequencyCurve curve{fmt::format("transverse {} of {}", n + 1, points.front().spans[k].name), {}, {}, 0};
      for (const Modes& p : points) curve.frequency_hz.push_back(p.spans[k].frequency_hz[n]);
      curves.push_back(std::move(curve));
    }
  return curves;
}

std::optional<std::string> range_near(const std::vector<RangeSpec>& ranges, double rpm) {
  const RangeSpec* nearest = nullptr;
  const auto distance = [&](const RangeSpec& r) { return std::abs(rpm - r.crank_rpm); };
  for (const RangeSpec& range : ranges)
    if (!nearest || distance(range) < distance(*nearest)) nearest = &range;
  if (!nearest || distance(*nearest) > near_share * nearest->crank_rpm) return {};
  return nearest->name;
}

}  // namespace

Campbell campbell(const Model& model, int points, const ModesOptions& options) {
  Campbell diagram;
  const auto& ranges = model.scene.range;
  if (ranges.empty() || model.pulleys == 0) return diagram;
  const auto [slow, fast] = std::minmax_element(
      ranges.begin(), ranges.end(), [](const RangeSpec& a, const RangeSpec& b) { return a.crank_rpm < b.crank_rpm; });
  const double first = (1 - near_share) * slow->crank_rpm, last = (1 + near_share) * fast->crank_rpm;
  if (last <= first) return diagram;  // nothing turns
  const double highest_hz = default_orders().back() * last / 60;
  std::vector<Modes> at;
  for (int i = 0; i < points; ++i) {
    diagram.crank_rpm.push_back(first + (last - first) * i / (points - 1));
    at.push_back(
        solve_modes(model, {.name = "", .crank_rpm = diagram.crank_rpm.back(), .condition = model.condition}, options));
    std::string state;
    for (const bool engaged : at.back().loop.gear_engaged) state += engaged ? '1' : '0';
    for (const ArmModes& arm : at.back().arms)
      state += fmt::format(" {}", std::count_if(arm.damped.begin(), arm.damped.end(), [&](const DampedMode& mode) {
                             return mode.frequency_hz < highest_hz;
                           }));
    diagram.states.push_back(std::move(state));
  }
  diagram.curves = rotational_curves(at, highest_hz);
  for (FrequencyCurve& curve : transverse_curves(at)) diagram.curves.push_back(std::move(curve));
  return diagram;
}

std::vector<Crossing> crossings(const Campbell& diagram, const std::vector<RangeSpec>& ranges) {
  std::vector<Crossing> found;
  for (const FrequencyCurve& curve : diagram.curves)
    for (const double order : default_orders())
      for (std::size_t i = 0; i + 1 < diagram.crank_rpm.size(); ++i) {
        if (diagram.states[i] != diagram.states[i + 1]) continue;
        const double n0 = diagram.crank_rpm[i], n1 = diagram.crank_rpm[i + 1];
        const double above0 = curve.frequency_hz[i] - order * n0 / 60;
        const double above1 = curve.frequency_hz[i + 1] - order * n1 / 60;
        if ((above0 < 0) == (above1 < 0)) continue;
        const double rpm = n0 + (n1 - n0) * above0 / (above0 - above1);
        found.push_back({order * rpm / 60, order, rpm, curve.name, curve.damping_ratio, range_near(ranges, rpm)});
      }
  std::stable_sort(found.begin(), found.end(), [](const Crossing& a, const Crossing& b) {
    return std::tie(a.order, a.crank_rpm) < std::tie(b.order, b.crank_rpm);
  });
  return found;
}

}  // namespace beltlife
