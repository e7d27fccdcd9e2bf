// Charts of a calibration: see calibrate_charts.h.
#include "calibrate/pages/calibrate_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "results/pages/gnuplot.h"
#include "results/pages/study/study_charts.h"
#include "results/pages/study/study_parts.h"
#include "sim/eval/quantity_unit.h"

namespace beltlife {
namespace {

constexpr double last_order = 9.5;    ///< of the spectra: what the thesis shows
constexpr std::size_t most_sets = 7;  ///< as many as there are colours

/// One side of a picture; null where a run failed.
struct Side {
  const CalculatedCurves* curves;
  const char *label, *colour;
  int dash;
};
/// Calculated ones last: they are drawn above the measured.
std::vector<Side> sides_of(const RecordPicture& p) {
  return {{&p.measured, "measured", "#000000", 1},
          {p.start ? &*p.start : nullptr, "start", "#e69f00", 2},
          {p.calibrated ? &*p.calibrated : nullptr, "calibrated", "#0072b2", 1}};
}

/// Per cent of the way from the lower bound to the upper; NaN where there is no such place.
double place_of(const FittedParameter& p, double v) {
  const double share =
      p.wide() ? std::log(v / p.lower) / std::log(p.upper / p.lower) : (v - p.lower) / (p.upper - p.lower);
  return share >= -0.001 && share <= 1.001 ? 100 * share : NAN;
}

/// A plot of a data block; nothing for an empty one, at which gnuplot would stop.
struct Plots {
  std::string data, plots;
  void add(const std::string& block, const std::string& rows, const std::string& how) {
    if (rows.empty()) return;
    data += fmt::format("${} << EOD\n{}EOD\n", block, rows);
    plots += fmt::format("{}${} {}", plots.empty() ? "" : ", ", block, how);
  }
};

/// Between its points a profile is a parabola where the model is linear: the signed root of the rise is interpolated.
std::pair<std::vector<double>, std::vector<double>> smooth(const FittedParameter& p, double least) {
  constexpr int parts = 12;
  std::vector<double> x, y;
  const auto root = [&](std::size_t k) {
    return (p.profile_value[k] < p.value ? -1 : 1) * std::sqrt(std::max(p.profile_cost[k] - least, 0.0));
  };
  for (std::size_t k = 0; k + 1 < std::min(p.profile_value.size(), p.profile_cost.size()); ++k)
    for (int i = 0; i <= parts; ++i) {
      const double t = static_cast<double>(i) / parts, r = root(k) + t * (root(k + 1) - root(k));
      x.push_back(p.profile_value[k] + t * (p.profile_value[k + 1] - p.profile_value[k]));
      y.push_back(least + r * r);
    }
  return {x, y};
}

MarkedChart::Series upright(double x, double low, double high, const char* label, int dash) {
  return {label, {x, x}, {low, high}, {}, "#d55e00", 0, dash, 1};
}

/// "idle.drive_shaft.speed_rpm" and 3 of "idle.drive_shaft.speed_rpm.order_3"; no order: NaN.
std::pair<std::string, double> order_of(const std::string& quantity) {
  constexpr std::string_view mark = ".order_";
  const std::size_t at = quantity.rfind(mark);
  if (at == quantity.npos) return {quantity, NAN};
  char* end = nullptr;
  const char* const begin = quantity.c_str() + at + mark.size();
  const double order = std::strtod(begin, &end);
  return {quantity.substr(0, at), end == begin || *end != '\0' ? NAN : order};
}

std::string unit_after(const std::string& words, const RecordPicture& picture) {
  const std::string unit = unit_of_name(picture.channel);
  return unit.empty() ? words : words + ", " + unit;
}

}  // namespace

std::string interval_chart(const std::string& id, const std::vector<FittedParameter>& parameters) {
  constexpr double pitch = 2;  // a row is a name and below it the track
  std::string tracks, intervals, profiles, values, starts, names;
  double top = 0;
  for (const FittedParameter& p : parameters) {
    if (!p.bounded() || !std::isfinite(place_of(p, p.value))) continue;
    const double y = top + 1.4, value = place_of(p, p.value), start = place_of(p, p.start);
    const auto ends = [&](std::string& to, double from, double until) {
      if (std::isfinite(from) && std::isfinite(until))
        to += fmt::format("{} {} {} {} {} {}\n", value, y, from, until, y - 0.22, y + 0.22);
    };
    tracks += fmt::format("50 {} 0 100 {} {}\n", y, y - 0.05, y + 0.05);
    ends(intervals, place_of(p, p.low), place_of(p, p.high));
    ends(profiles, place_of(p, p.profile_low), place_of(p, p.profile_high));
    values += fmt::format("{} {}\n", value, y);
    if (std::isfinite(start)) starts += fmt::format("{} {}\n", start, y);
    names += fmt::format("set label {} at first 0, first {} left front\n",
                         gnuplot_quoted(p.name + (p.wide() ? " (log)" : "")), top + 0.7);
    top += pitch;
  }
  if (values.empty()) return "";
  Plots plots;
  plots.add("track", tracks, "using 1:2:3:4:5:6 with boxxyerror lc rgb '#cccccc' notitle");
  plots.add("interval", intervals, "using 1:2:3:4:5:6 with boxxyerror lc rgb '#56b4e9' title 'interval'");
  plots.add("profile", profiles, "using 1:2:3:4 with xerrorbars lc rgb '#222222' lw 1.2 pt 0 ps 0 title 'by profile'");
  plots.add("start", starts, "using 1:2 with points lc rgb '#d55e00' lw 1.5 pt 4 ps 0.8 title 'start'");
  plots.add("value", values, "using 1:2 with points lc rgb '#000000' pt 7 ps 0.6 title 'calibrated'");
  return svg_of_script(
      id,
      fmt::format("set encoding utf8\n"
                  "set terminal svg size 480,{} dynamic noenhanced font 'Helvetica,11' linewidth 1.2\n"
                  "set xrange [-4:104]\nset yrange [{}:0]\nunset ytics\nset border 1\nset xtics 0,25,100 nomirror\n"
                  "set grid xtics lc rgb '#dddddd'\nset xlabel 'from the lower to the upper bound, %' offset 0,0.4\n"
                  "set key outside top center horizontal\nset style fill solid 0.9 noborder\n",
                  90 + static_cast<int>(19 * top), top) +
          names + plots.data + "plot " + plots.plots + "\n");
}

std::string profile_chart(const std::string& id, const FittedParameter& p, double level) {
  const std::size_t count = std::min(p.profile_value.size(), p.profile_cost.size());
  double least = INFINITY, most = -INFINITY;
  for (std::size_t k = 0; k < count; ++k)
    if (std::isfinite(p.profile_value[k]) && std::isfinite(p.profile_cost[k])) {
      least = std::min(least, p.profile_cost[k]);
      most = std::max(most, p.profile_cost[k]);
    }
  if (count < 2 || !(least <= most)) return "";
  if (std::isfinite(level)) most = std::max(most, level);
  auto [x, y] = smooth(p, least);
  // Tics such as 1.25e-05 would run into each other.
  const double size = std::abs(p.profile_value.back());
  const int power =
      size > 0 && (size < 0.01 || size >= 1e4) ? 3 * static_cast<int>(std::floor(std::log10(size) / 3)) : 0;
  const double scale = std::pow(10.0, -power);
  const auto scaled = [&](std::vector<double> v) {
    for (double& one : v) one *= scale;
    return v;
  };
  std::string unit = unit_of_name(p.name);
  if (power != 0) unit = fmt::format("1e{}{}{}", power, unit.empty() ? "" : " ", unit);
  MarkedChart chart{id, p.name, unit.empty() ? "value" : "value, " + unit, "cost"};
  chart.height = 250;
  chart.series = {{"", scaled(std::move(x)), std::move(y), {}, safe_colour(0), 0},
                  {"points", scaled(p.profile_value), p.profile_cost, {}, safe_colour(0), 7, 0, 0.8}};
  for (const double v : {p.profile_low, p.profile_high})
    if (std::isfinite(v))
      chart.series.push_back(upright(scale * v, least, most, chart.series.size() == 2 ? "by profile" : "", 1));
  const std::size_t drawn = chart.series.size();
  for (const double v : {p.low, p.high})
    if (std::isfinite(v))
      chart.series.push_back(upright(scale * v, least, most, chart.series.size() == drawn ? "by curvature" : "", 3));
  if (std::isfinite(level)) chart.levels = {{"allowed", level, 2}};
  return svg_of(chart);
}

std::string cost_chart(const std::string& id, const CalibrationAnswer& answer) {
  const std::vector<FitAnswer>& fits = answer.fits;
  if (fits.empty()) return "";
  const auto best = static_cast<std::size_t>(answer.best_fit);
  MarkedChart chart{id, "", "points asked", "cost", false, true};
  bool others = false;
  // The final fit last and the best before it: neither is to be hidden by the rest.
  for (const int turn : {0, 1, 2})
    for (std::size_t k = 0; k < fits.size(); ++k) {
      const bool last = k + 1 == fits.size() && k > 0, is_best = !last && k == best;
      if ((last ? 2 : is_best ? 1 : 0) != turn || !fits[k].points || !fits[k].costs) continue;
      MarkedChart::Series s{"", {fits[k].points->begin(), fits[k].points->end()}, *fits[k].costs};
      const std::size_t count = std::min(s.x.size(), s.y.size());
      s.x.resize(count);
      s.y.resize(count);
      s.label = last ? "the final fit" : is_best ? "the best fit" : others ? "" : "other fits";
      s.colour = last ? "#d55e00" : is_best ? "#0072b2" : "#999999";
      s.mark = last ? 5 : 7;
      s.size = last ? 1.2 : 0.7;
      if (count == 0) continue;
      others = others || turn == 0;
      chart.series.push_back(std::move(s));
    }
  return svg_of(chart);
}

std::string spectrum_chart(const std::string& id, const RecordPicture& picture) {
  const double rpm = picture.crank_rpm, noise = picture.noise;
  const double end = rpm > 0 ? last_order * rpm / 60 : INFINITY;
  MarkedChart chart{id,
                    "",
                    rpm > 0 ? fmt::format("frequency, Hz (order 1: {} Hz)", digits_text(rpm / 60, 4)) : "frequency, Hz",
                    unit_after("amplitude", picture),
                    false,
                    true};
  double peak = 0;
  for (const Side& side : sides_of(picture)) {
    if (!side.curves) continue;
    const auto &x = side.curves->frequency_hz, &y = side.curves->amplitude;
    MarkedChart::Series s{side.label, {}, {}, {}, side.colour, 0, side.dash};
    for (std::size_t k = 0; k < std::min(x.size(), y.size()); ++k) {
      if (!(x[k] > 0 && x[k] <= end && std::isfinite(y[k]))) continue;
      s.x.push_back(x[k]);
      s.y.push_back(y[k]);
      peak = std::max(peak, y[k]);
    }
    if (!s.x.empty()) chart.series.push_back(std::move(s));
  }
  if (!(peak > 0)) return "";
  // Below the noise nothing is compared; the calculated spectrum would reach down to rounding.
  const double bottom = noise > 0 ? std::clamp(0.2 * noise, 1e-6 * peak, 1e-2 * peak) : 1e-5 * peak;
  for (MarkedChart::Series& s : chart.series)
    for (double& v : s.y) v = std::max(v, bottom);
  if (noise > 0) chart.levels = {{"noise", noise, 3}};
  return svg_of(chart);
}

std::string trace_chart(const std::string& id, const RecordPicture& picture) {
  const std::vector<double>& angle = picture.measured.angle_deg;
  MarkedChart chart{id, "", "crank angle, deg", unit_after("deviation from the mean", picture)};
  for (const Side& side : sides_of(picture)) {
    // Another number of places is another division of the revolutions.
    if (!side.curves || side.curves->trace.empty() || side.curves->trace.size() != angle.size()) continue;
    chart.series.push_back({side.label, angle, side.curves->trace, {}, side.colour, 0, side.dash});
  }
  return svg_of(chart);
}

std::string residual_chart(const std::string& id, const std::vector<ResidualAnswer>& residuals) {
  MarkedChart chart{id, "", "order of crank rotation", "residual, standard deviations"};
  for (const ResidualAnswer& row : residuals) {
    const auto [set, order] = order_of(row.quantity);
    if (!std::isfinite(order) || !std::isfinite(row.residual)) continue;
    const auto found =
        std::find_if(chart.series.begin(), chart.series.end(), [&](const auto& s) { return s.label == set; });
    const auto index = static_cast<std::size_t>(found - chart.series.begin());
    if (index == most_sets) continue;
    if (index == chart.series.size())
      chart.series.push_back({set, {}, {}, {}, safe_colour(index), static_cast<int>(5 + 2 * (index % 4)), 0});
    chart.series[index].x.push_back(order);
    chart.series[index].y.push_back(row.residual);
  }
  if (chart.series.empty()) return "";
  chart.levels = {{"3 deviations", 3, 2}, {"", 0, 1}, {"", -3, 2}};
  return svg_of(chart);
}

}  // namespace beltlife
