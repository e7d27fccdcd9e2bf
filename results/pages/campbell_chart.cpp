// The map of natural frequencies over crank speed: see campbell_chart.h.
#include "results/pages/campbell_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>

#include "results/pages/gnuplot.h"
#include "sim/signal/spectrum.h"

namespace beltlife {
namespace {

// Speeds of the ranges as grey bars; ranges at the same speed share one, and near ones get their names on two levels.
std::string range_bars(const SceneSpec& scene, double first, double last, double top) {
  std::vector<std::pair<double, std::string>> bars;
  for (const RangeSpec& range : scene.range) bars.emplace_back(range.crank_rpm, range.name);
  std::stable_sort(bars.begin(), bars.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::string s;
  double before = -1e9;
  bool raised = false;
  for (const auto& [rpm, name] : bars) {
    if (rpm == before) continue;
    raised = rpm - before < 0.12 * (last - first) && !raised;
    s += fmt::format("set arrow from {0},0 to {0},{1} nohead lc rgb '#dddddd' lw 6 back\n", rpm, top);
    s += fmt::format("set label {} at {},{} center offset 0,{} font ',11' tc rgb '#555555'\n", gnuplot_quoted(name),
                     rpm, top, raised ? 1.6 : 0.7);
    before = rpm;
  }
  return s;
}

std::string order_rays(const std::vector<double>& orders, double first, double last, double top) {
  std::string s;
  for (const double order : orders) {
    const double end = std::min(last, 60 * top / order);
    if (end <= first) continue;
    s += fmt::format("set arrow from {},{} to {},{} nohead lc rgb '#999999' lw 0.6 back\n", first, order * first / 60,
                     end, order * end / 60);
    s += fmt::format("set label '{:g}' at {},{} right offset -0.3,{} font ',10' tc rgb '#666666'\n", order, end,
                     order * end / 60, end < last ? -0.5 : 0.4);
  }
  return s;
}

// Data blocks $c0, $c1, ... of the curves and $near of the crossings that are shown.
std::string data_blocks(const DriveModes& modes, const std::function<bool(const Crossing&)>& shown) {
  std::string s = "$near << EOD\n";
  for (const Crossing& c : modes.crossings)
    if (shown(c)) s += fmt::format("{} {}\n", c.crank_rpm, c.frequency_hz);
  s += "EOD\n";
  const Campbell& map = modes.map;
  for (std::size_t i = 0; i < map.curves.size(); ++i) {
    s += fmt::format("$c{} << EOD\n", i);
    for (std::size_t k = 0; k < map.crank_rpm.size(); ++k)
      s += fmt::format("{} {}\n", map.crank_rpm[k], map.curves[i].frequency_hz[k]);
    s += "EOD\n";
  }
  return s;
}

// gnuplot stops at an empty data block.
std::string points(const DriveModes& modes, const std::function<bool(const Crossing&)>& shown) {
  const bool any = std::any_of(modes.crossings.begin(), modes.crossings.end(), shown);
  return any ? "$near with points pt 7 ps 0.5 lc rgb 'black' title 'crossing near a range'\n" : "1/0 notitle\n";
}

std::string line_style(const FrequencyCurve& curve, int color) {
  if (!curve.arm) return fmt::format("lc {} lw 1 dt 3", color);
  return fmt::format("lc {} lw 2 dt {}", color, *curve.arm == ArmState::stuck ? 2 : 1);
}

struct Kind {
  std::string title, style;
};

Kind kind_of(const FrequencyCurve& curve) {
  if (!curve.arm) return {"transverse, first and second of each span", "lc rgb '#2e933c' lw 1 dt 3"};
  switch (*curve.arm) {
    case ArmState::free:
      return {"rotational, arm free", "lc rgb '#0b61a4' lw 2"};
    case ArmState::stuck:
      return {"rotational, arm stuck", "lc rgb '#d1495b' lw 2 dt 2"};
    case ArmState::locked:
    case ArmState::none:
      break;
  }
  return {"rotational", "lc rgb '#0b61a4' lw 2"};
}

}  // namespace

std::string map_script(const SceneSpec& scene, const DriveModes& modes) {
  const double first = modes.map.crank_rpm.front(), last = modes.map.crank_rpm.back();
  const double top = default_orders().back() * last / 60;
  const auto shown = [](const Crossing& c) { return c.near.has_value(); };
  std::string s =
      "set terminal svg size 1200,760 dynamic noenhanced background rgb 'white'\n"
      "set xlabel 'crank speed, r/min'\nset ylabel 'frequency, Hz'\nset key outside right top noenhanced\n"
      "set grid lc rgb '#e6e6e6'\nset rmargin 46\n";
  s += fmt::format("set title {} offset 0,1.2\nset xrange [{}:{}]\nset yrange [0:{}]\n", gnuplot_quoted(scene.title),
                   first, last, top);
  s += range_bars(scene, first, last, top) + order_rays(default_orders(), first, last, top) + data_blocks(modes, shown);
  s += "plot ";
  const auto& curves = modes.map.curves;
  for (std::size_t i = 0; i < curves.size(); ++i)
    s += fmt::format("$c{} with lines {} title {}, ", i, line_style(curves[i], static_cast<int>(i % 8) + 1),
                     gnuplot_quoted(curves[i].name));
  return s + points(modes, shown);
}

std::string small_map_script(const SceneSpec& scene, const DriveModes& modes) {
  const double first = modes.map.crank_rpm.front(), last = modes.map.crank_rpm.back();
  std::vector<double> orders;
  for (const double order : default_orders())
    if (has_order(scene, order)) orders.push_back(order);
  const double top = (orders.empty() ? default_orders().back() : orders.back()) * last / 60;
  const auto shown = [&](const Crossing& c) { return can_resonate(c, scene); };
  std::string s =
      "set terminal svg size 960,560 dynamic noenhanced font 'Helvetica,12'\n"
      "set xlabel 'crank speed, r/min' offset 0,0.4\nset ylabel 'frequency, Hz'\n"
      "set key below center maxrows 2\nset grid lc rgb '#e6e6e6'\nset tmargin 3\n";
  s += fmt::format("set xrange [{}:{}]\nset yrange [0:{}]\n", first, last, top);
  s += range_bars(scene, first, last, top) + order_rays(orders, first, last, top) + data_blocks(modes, shown);
  s += "plot ";
  std::set<std::string> in_key;
  const auto& curves = modes.map.curves;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const Kind kind = kind_of(curves[i]);
    const bool first_of_kind = in_key.insert(kind.title).second;
    s += fmt::format("$c{} with lines {} {}, ", i, kind.style,
                     first_of_kind ? "title " + gnuplot_quoted(kind.title) : std::string("notitle"));
  }
  return s + points(modes, shown);
}

}  // namespace beltlife
