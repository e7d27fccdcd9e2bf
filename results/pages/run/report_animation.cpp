// The running belt on a report page: see report_animation.h.
#include "results/pages/run/report_animation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "results/pages/assets.h"
#include "results/pages/html.h"

namespace beltlife {
namespace {

constexpr double budget = 1.2e6;  // characters of base64 on a page
constexpr double characters_per_node = 5 * 4.0 / 3;
constexpr std::size_t fewest_nodes = 96, fewest_frames = 8;

using Bytes = std::vector<std::uint8_t>;

std::string base64(const Bytes& bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t word = static_cast<std::uint32_t>(bytes[i]) << 16;
    if (left > 1) word |= static_cast<std::uint32_t>(bytes[i + 1]) << 8;
    if (left > 2) word |= bytes[i + 2];
    for (std::size_t k = 0; k < 4; ++k) text += k <= left ? digits[word >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

struct Extent {
  double low = 1e300, high = -1e300;
  void take(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  /// Place of a value in [0, levels].
  unsigned level(double value, unsigned levels) const {
    return high > low ? static_cast<unsigned>(std::lround((value - low) / (high - low) * levels)) : 0;
  }
};

/// Every so many nodes and frames.
struct Stride {
  std::size_t nodes = 1, frames = 1;
};

/// A drive that failed may be anywhere.
bool plays(const WindowRecord& w) { return w.complete && w.frames.time_s.size() >= 2 && w.frames.nodes() >= 3; }

/// Frames that are shown: counted back from the last.
std::vector<std::size_t> shown(const Frames& f, std::size_t stride) {
  std::vector<std::size_t> frames;
  for (std::size_t k = (f.time_s.size() - 1) % stride; k < f.time_s.size(); k += stride) frames.push_back(k);
  return frames;
}

/// Nodes go first: neighbours are nearly on one line, while between frames the belt moves on by some nodes.
Stride stride_of(const Subject& s) {
  Stride stride;
  const auto too_long = [&] {
    double characters = 0;
    for (const Subject::Range& r : s.ranges)
      if (const Frames& f = r.window->frames; plays(*r.window))
        characters += characters_per_node * std::ceil(static_cast<double>(f.nodes()) / stride.nodes) *
                      static_cast<double>(shown(f, stride.frames).size());
    return characters > budget;
  };
  std::size_t nodes = 0, frames = 0;
  for (const Subject::Range& r : s.ranges) {
    nodes = std::max(nodes, r.window->frames.nodes());
    frames = std::max(frames, r.window->frames.time_s.size());
  }
  while (too_long()) {
    if (nodes / (stride.nodes + 1) >= fewest_nodes)
      ++stride.nodes;
    else if (frames / (stride.frames + 1) >= fewest_frames)
      ++stride.frames;
    else
      break;
  }
  return stride;
}

/// To so many parts of one; divided last, so that few digits are written.
double rounded(double value, double parts) { return std::round(value * parts) / parts; }

nlohmann::json range_data(const Subject& s, const Subject::Range& r, const Stride& stride, const Extent& x,
                          const Extent& y) {
  const Frames& f = r.window->frames;
  const std::vector<std::size_t> frames = shown(f, stride.frames);
  const std::size_t nodes = f.nodes(), pulleys = f.pulleys();
  Extent tension;
  for (std::size_t k : frames)
    for (std::size_t i = 0; i < nodes; i += stride.nodes) tension.take(f.tension_n[k * nodes + i]);
  Bytes xs, ys, tensions;
  nlohmann::json time = nlohmann::json::array(), turn = nlohmann::json::array(), centre = nlohmann::json::array();
  const std::size_t arm = s.model.tensioner.pulley >= 0 ? static_cast<std::size_t>(s.model.tensioner.pulley) : pulleys;
  for (std::size_t k : frames) {
    for (std::size_t i = 0; i < nodes; i += stride.nodes) {
      const std::size_t at = k * nodes + i;
      for (const auto& [bytes, level] :
           {std::pair{&xs, x.level(f.x_m[at], 65535)}, std::pair{&ys, y.level(f.y_m[at], 65535)}}) {
        bytes->push_back(static_cast<std::uint8_t>(level & 255));
        bytes->push_back(static_cast<std::uint8_t>(level >> 8));
      }
      tensions.push_back(static_cast<std::uint8_t>(tension.level(f.tension_n[at], 255)));
    }
    time.push_back(rounded(1e3 * (f.time_s[k] - f.time_s[frames.front()]), 1e3));
    nlohmann::json turns = nlohmann::json::array();
    for (std::size_t p = 0; p < pulleys; ++p) {
      const double whole = 2 * std::numbers::pi;
      const double begin = whole * std::floor(f.pulley_angle_rad[frames.front() * pulleys + p] / whole);
      turns.push_back(rounded(f.pulley_angle_rad[k * pulleys + p] - begin, 1e3));
    }
    turn.push_back(std::move(turns));
    if (arm < pulleys)
      centre.push_back({rounded(f.pulley_x_m[k * pulleys + arm], 1e6), rounded(f.pulley_y_m[k * pulleys + arm], 1e6)});
  }
  return {{"name", r.window->range},
          {"crank_rpm", std::round(r.window->crank_rpm)},
          {"nodes", xs.size() / 2 / frames.size()},
          {"time_ms", time},
          {"turn", turn},
          {"centre", centre},
          {"tension_n", {tension.low, tension.high}},
          {"x", base64(xs)},
          {"y", base64(ys)},
          {"tension", base64(tensions)}};
}

/// Text of JSON that may stand in a script element, whatever names it holds.
std::string in_script(const nlohmann::json& json) {
  std::string text;
  for (const char c : json.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace))
    text += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return text;
}

// 0.0501 and not 0.050100000000000006: shorter, and no reader needs the rest.
double to_micrometre(double metres) { return std::round(metres * 1e6) / 1e6; }

}  // namespace

nlohmann::json animation_data(const Subject& s) {
  const Model& m = s.model;
  Extent x, y;
  for (const Subject::Range& r : s.ranges) {
    if (!plays(*r.window)) continue;
    for (double value : r.window->frames.x_m) x.take(value);
    for (double value : r.window->frames.y_m) y.take(value);
  }
  if (x.high < x.low) return nullptr;
  nlohmann::json pulleys = nlohmann::json::array(), ranges = nlohmann::json::array();
  const nlohmann::json box{x.low, x.high, y.low, y.high};
  for (std::size_t p = 0; p < m.scene.pulley.size(); ++p)
    pulleys.push_back({{"name", m.scene.pulley[p].name},
                       {"x", to_micrometre(m.pulley_x[p])},
                       {"y", to_micrometre(m.pulley_y[p])},
                       {"radius", to_micrometre(m.pulley_radius[p])},
                       {"front", m.scene.pulley[p].side == Side::front}});
  nlohmann::json first = 0;
  const Subject::Range* at_first = shown_range(s);
  const Stride stride = stride_of(s);
  for (const Subject::Range& r : s.ranges) {
    if (!plays(*r.window)) continue;
    if (&r == at_first) first = ranges.size();
    ranges.push_back(range_data(s, r, stride, x, y));
  }
  nlohmann::json arm = nullptr;
  if (m.tensioner.pulley >= 0)
    arm = {{"pulley", m.tensioner.pulley},
           {"x", to_micrometre(m.tensioner.pivot_x)},
           {"y", to_micrometre(m.tensioner.pivot_y)}};
  return {{"box", box}, {"pulleys", pulleys}, {"arm", arm}, {"first", first}, {"ranges", ranges}};
}

std::string animation_section(const Subject& s) {
  const nlohmann::json data = animation_data(s);
  if (data.is_null()) return "";
  std::string ranges, speeds;
  for (std::size_t i = 0; i < data["ranges"].size(); ++i)
    ranges += fmt::format("<option value=\"{}\"{}>{}</option>", i, data["first"] == i ? " selected" : "",
                          html_escaped(data["ranges"][i]["name"].get<std::string>()));
  for (int slower : {10, 20, 50, 100, 200, 500, 1000})
    speeds += fmt::format("<option value=\"{0}\"{1}>1/{0}</option>", slower, slower == 50 ? " selected" : "");
  return fmt::format(
             "<section id=\"animation\"><h2>Running belt</h2>\n<p>{} each evaluated window, as simulated, in slow "
             "motion. "
             "Colour is the tension of each piece of belt.</p>\n"
             "<noscript><p>The animation is drawn by a script in this page, and scripts are off.</p></noscript>\n"
             "<figure class=\"run\"><canvas id=\"animation-picture\" role=\"img\" aria-label=\"the running "
             "belt\"></canvas>\n"
             "<div><div class=\"scale\"><span id=\"animation-low\"></span><span class=\"colours\"></span>"
             "<span id=\"animation-high\"></span></div>\n"
             "<div class=\"player\" role=\"group\" aria-label=\"animation controls\">"
             "<button type=\"button\" id=\"animation-play\">Play</button>"
             "<label>Range <select id=\"animation-range\">{}</select></label>"
             "<label>Speed <select id=\"animation-speed\">{}</select></label>"
             "<label class=\"time\">Time <input type=\"range\" id=\"animation-time\" min=\"0\" max=\"1000\" step=\"1\" "
             "value=\"0\"></label></div>\n"
             "<figcaption><p id=\"animation-now\"></p><p id=\"animation-printed\" class=\"printed\"></p>"
             "<p>White arrow heads run with the belt; the ringed point is one point of it.{}</p>"
             "</figcaption></div></figure>\n",
             s.model.driver.body >= 0 ? "The last two revolutions of the driven body in"
                                      : "The last tenth of a second of",
             ranges, speeds,
             s.model.pulleys > 0 ? " Every pulley has a dark mark, so that its turning is seen. Ribs run on the grey "
                                   "pulleys, the back on the beige ones."
                                 : "") +
         "<script type=\"application/json\" id=\"animation-data\">" + in_script(data) + "</script>\n<script>" +
         animation_player + "</script></section>\n";
}

}  // namespace beltlife
