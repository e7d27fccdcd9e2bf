// The map of a sweep: see sweep_chart.h.
#include "results/pages/sweep_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "results/pages/gnuplot.h"

namespace beltlife {
namespace {

constexpr int columns = 300, rows = 220;
constexpr double decades = 1e-3;

/// Amplitude at a place and an order between the map's; not a number outside them.
double at(const Sweep& s, const SweepChannel& c, std::size_t place, double order) {
  const double k = (order - s.orders.front()) / (s.orders[1] - s.orders[0]);
  if (k < 0 || k > static_cast<double>(s.orders.size() - 1)) return std::nan("");
  const auto below = std::min(static_cast<std::size_t>(k), s.orders.size() - 2);
  const double share = k - static_cast<double>(below);
  return (1 - share) * c.amplitude[below][place] + share * c.amplitude[below + 1][place];
}

std::size_t nearest_place(const Sweep& s, double rpm) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < s.crank_rpm.size(); ++i)
    if (std::abs(s.crank_rpm[i] - rpm) < std::abs(s.crank_rpm[best] - rpm)) best = i;
  return best;
}

std::string image(const Sweep& s, const SweepChannel& c, double low, double high, double top, double least) {
  std::string block = "$map << EOD\n";
  std::vector<std::size_t> place(columns);
  std::vector<double> rpm(columns);
  for (int i = 0; i < columns; ++i) {
    rpm[i] = low + (high - low) * i / (columns - 1);
    place[i] = nearest_place(s, rpm[i]);
  }
  for (int j = 0; j < rows; ++j) {
    const double hz = top * (j + 0.5) / rows;
    for (int i = 0; i < columns; ++i) {
      const double value = at(s, c, place[i], 60 * hz / rpm[i]);
      block += std::isnan(value) ? "NaN " : fmt::format("{:.3g} ", std::max(value, least));
    }
    block += "\n";
  }
  return block + "EOD\n";
}

std::string rays(const Sweep& s, double low, double high, double top) {
  std::string out;
  for (double order = 1; order <= s.orders.back(); ++order) {
    const double end = std::min(high, 60 * top / order);
    out += fmt::format("set arrow from {},{} to {},{} nohead lc rgb '#a0ffffff' lw 0.6 front\n", low, order * low / 60,
                       end, order * end / 60);
    out += fmt::format("set label '{:g}' at {},{} left offset 0.3,0 font ',10' tc rgb '#444444' front\n", order, end,
                       order * end / 60);
  }
  return out;
}

struct Kind {
  std::string title, style;
};

Kind kind_of(const FrequencyCurve& curve) {
  if (!curve.arm) return {"transverse, first and second of each span", "lc rgb '#ff9da7' lw 1 dt 3"};
  if (*curve.arm == ArmState::stuck) return {"rotational, arm stuck", "lc rgb '#ff6f61' lw 1.6 dt 2"};
  return {*curve.arm == ArmState::free ? "rotational, arm free" : "rotational", "lc rgb '#ff6f61' lw 1.6"};
}

}  // namespace

std::string sweep_map_script(const Sweep& s, const SweepChannel& c) {
  const auto [slow, fast] = std::minmax_element(s.crank_rpm.begin(), s.crank_rpm.end());
  const double low = *slow, high = *fast, top = s.orders.back() * high / 60;
  double largest = 0;
  for (const auto& row : c.amplitude)
    for (const double a : row)
      if (a > largest) largest = a;
  std::string script =
      "set terminal svg size 960,600 dynamic noenhanced font 'Helvetica,12'\n"
      "set xlabel 'crank speed, r/min' offset 0,0.4\nset ylabel 'frequency, Hz'\nset key below center maxrows 2\n"
      "set palette defined (0 '#0d0887', 0.35 '#1f78b4', 0.6 '#2ca58d', 0.8 '#b5de2b', 1 '#fde725')\n"
      "set logscale cb\nset format cb '%g'\nset rmargin at screen 0.86\n";
  script += fmt::format("set cblabel {}\nset cbrange [{:.3g}:{:.3g}]\nset xrange [{}:{}]\nset yrange [0:{}]\n",
                        gnuplot_quoted("amplitude, " + c.unit), largest * decades, largest, low, high, top);
  script += rays(s, low, high, top) + image(s, c, low, high, top, largest * decades);
  for (std::size_t i = 0; i < s.modes.curves.size(); ++i) {
    script += fmt::format("$c{} << EOD\n", i);
    for (std::size_t k = 0; k < s.modes.crank_rpm.size(); ++k)
      script += fmt::format("{:.6g} {:.6g}\n", s.modes.crank_rpm[k], s.modes.curves[i].frequency_hz[k]);
    script += "EOD\n";
  }
  script += fmt::format("plot $map matrix using ({}+$1*{}):({}+$2*{}):3 with image notitle", low,
                        (high - low) / (columns - 1), 0.5 * top / rows, top / rows);
  std::set<std::string> in_key;
  for (std::size_t i = 0; i < s.modes.curves.size(); ++i) {
    const Kind kind = kind_of(s.modes.curves[i]);
    script += fmt::format(", $c{} with lines {} {}", i, kind.style,
                          in_key.insert(kind.title).second ? "title " + gnuplot_quoted(kind.title) : "notitle");
  }
  return script + "\n";
}

}  // namespace beltlife
