// Early end of a range: see settling.h.
#include "sim/eval/settling.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace beltlife {
namespace {

double relative(double a, double b) {
  const double size = std::max(std::abs(a), std::abs(b));
  return size > 0 ? std::abs(a - b) / size : 0;
}

// The order with the largest amplitude, after the later block.
double order_change(const OutputSummary& before, const OutputSummary& after) {
  double change = 0, most_speed = 0, most_torque = 0;
  for (std::size_t i = 0; i < after.orders.size(); ++i) {
    const OrderLine &a = before.orders[i], &b = after.orders[i];
    if (b.speed_rpm > most_speed) {
      most_speed = b.speed_rpm;
      change = relative(a.speed_rpm, b.speed_rpm);
    }
  }
  for (std::size_t i = 0; i < after.orders.size(); ++i)
    most_torque = std::max(most_torque, std::isfinite(after.orders[i].torque_n_m) ? after.orders[i].torque_n_m : 0.0);
  for (std::size_t i = 0; i < after.orders.size(); ++i)
    if (after.orders[i].torque_n_m == most_torque)
      change = std::max(change, relative(before.orders[i].torque_n_m, most_torque));
  return change;
}

std::vector<std::size_t> complete_windows(const RunRecord& record) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < record.windows.size(); ++i)
    if (record.windows[i].complete) indices.push_back(i);
  return indices;
}

}  // namespace

double largest_change(const RangeSummary& before, const RangeSummary& after) {
  double change = 0;
  for (std::size_t i = 0; i < after.spans.size(); ++i) {
    const SpanSummary &a = before.spans[i], &b = after.spans[i];
    change = std::max({change, relative(a.tension_n_mean, b.tension_n_mean), relative(a.tension_n_min, b.tension_n_min),
                       relative(a.tension_n_max, b.tension_n_max)});
  }
  for (std::size_t i = 0; i < after.pulleys.size(); ++i)
    if (after.pulleys[i].slip_percent && before.pulleys[i].slip_percent)
      change = std::max(change, std::abs(*after.pulleys[i].slip_percent - *before.pulleys[i].slip_percent));
  if (after.output && before.output)
    change = std::max({change, relative(before.output->speed_rpm_mean, after.output->speed_rpm_mean),
                       relative(before.output->torque_n_m_mean, after.output->torque_n_m_mean),
                       order_change(*before.output, *after.output)});
  return change;
}

bool settled(const Model& model, const RunRecord& record, double tolerance) {
  const auto windows = complete_windows(record);
  if (windows.size() < 2) return false;
  const RangeSummary before = summarise(model, record, record.windows[windows[windows.size() - 2]]);
  return largest_change(before, summarise(model, record, record.windows[windows.back()])) <= tolerance;
}

void keep_last_window(const Model& model, RunRecord& record) {
  const auto windows = complete_windows(record);
  if (!record.status.ok() || windows.empty()) {
    const std::size_t failed = std::min(windows.size(), record.windows.size() - 1);  // windows end in their order
    record.windows = {WindowRecord(std::move(record.windows[failed]))};
    return;
  }
  if (windows.size() > 1)
    record.settling_change = largest_change(summarise(model, record, record.windows[windows[windows.size() - 2]]),
                                            summarise(model, record, record.windows[windows.back()]));
  record.windows = {WindowRecord(std::move(record.windows[windows.back()]))};
}

}  // namespace beltlife
