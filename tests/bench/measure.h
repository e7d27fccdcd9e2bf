// Owns how the targets are measured: clocks, medians over work run in turn, and the machine that it ran on.
#pragma once

#include <fmt/chrono.h>
#include <stdlib.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

namespace beltlife::bench {

using Json = nlohmann::ordered_json;

/// Seconds that a piece of work took: of the process on all its cores, and on the clock on the wall.
struct Cost {
  double cpu_s = 0, wall_s = 0;
};

inline Cost cost_of(const std::function<void()>& work) {
  const auto wall = std::chrono::steady_clock::now();
  const std::clock_t cpu = std::clock();
  work();
  return {static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC,
          std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count()};
}

/// Upper median; not a number of nothing.
inline double median(std::vector<double> v) {
  if (v.empty()) return std::nan("");
  const auto middle = v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2);
  std::nth_element(v.begin(), middle, v.end());
  return *middle;
}

/// Median costs of several pieces of work, which take turns: whatever else the machine does meets them alike.
inline std::vector<Cost> costs_of(int rounds, const std::vector<std::function<void()>>& works) {
  std::vector<std::vector<double>> cpu(works.size()), wall(works.size());
  for (int round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < works.size(); ++i) {
      const Cost c = cost_of(works[i]);
      cpu[i].push_back(c.cpu_s);
      wall[i].push_back(c.wall_s);
    }
  std::vector<Cost> medians;
  for (std::size_t i = 0; i < works.size(); ++i) medians.push_back({median(cpu[i]), median(wall[i])});
  return medians;
}

inline Json load_average() {
  double load[3] = {std::nan(""), std::nan(""), std::nan("")};
  getloadavg(load, 3);
  return Json{load[0], load[1], load[2]};
}

inline Json machine() {
  std::string cpu = "unknown";
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) {
      cpu = line.substr(line.find(':') + 2);
      break;
    }
  return {{"cpu", cpu},
          {"threads", std::thread::hardware_concurrency()},
          {"compiler", __VERSION__},
          {"date", fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(std::time(nullptr)))},
          {"load_average_at_start", load_average()}};
}

}  // namespace beltlife::bench
