// Residuals and derivatives by batches: see fit_model.h.
#include "calibrate/fit_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/eval/difference_noise.h"

namespace beltlife {
namespace {

/// Neighbours of u in parameter i: `plus` and `minus` as far as the bounds let them.
struct Neighbour {
  std::size_t parameter = 0;
  double du = 0;
};

std::vector<double> moved(std::vector<double> u, const Neighbour& n) {
  u[n.parameter] += n.du;
  return u;
}

}  // namespace

FitModel::FitModel(FitProblem problem)
    : problem_(std::move(problem)), coordinates_(coordinates_of(problem_.parameters)) {}

void FitModel::set_noise(double noise) {
  noise_ = noise;
  step_ = std::clamp(2 * std::sqrt(noise), 1e-7, 0.1);
  central_step_ = std::clamp(std::cbrt(noise), 1e-5, 0.1);
}

std::vector<Answer> FitModel::ask(const std::vector<std::vector<double>>& us, const std::string& what) {
  std::vector<Point> points;
  for (const auto& u : us) points.push_back(point_at(coordinates_, u));
  asked_.insert(points.begin(), points.end());
  return problem_.evaluate(points, what);
}

Eigen::VectorXd FitModel::residuals_of(const Answer& answer) const {
  if (!answer.ok()) return {};
  Eigen::VectorXd r(static_cast<Eigen::Index>(problem_.targets.size()));
  for (std::size_t k = 0; k < problem_.targets.size(); ++k)
    r(static_cast<Eigen::Index>(k)) = problem_.targets[k].residual(answer.values[problem_.targets[k].column]);
  return r.allFinite() ? r : Eigen::VectorXd{};
}

std::vector<Eigen::VectorXd> FitModel::residuals_at(const std::vector<std::vector<double>>& us,
                                                    const std::string& what) {
  std::vector<Eigen::VectorXd> out;
  for (const Answer& a : ask(us, what)) out.push_back(residuals_of(a));
  return out;
}

void FitModel::measure_noise(const std::vector<double>& u) {
  constexpr int count = 7;
  std::vector<std::vector<double>> us;
  for (int k = 0; k < count; ++k) {
    std::vector<double> v = u;
    for (std::size_t i = 0; i < u.size(); ++i) {
      const Coordinate& c = coordinates_[i];
      const double d = c.step(u[i], 1e-5);
      // Away from a bound that is near; signs alternate so that effects do not all add up.
      const bool down = u[i] + count * d > c.upper() || (i % 2 == 1 && u[i] - count * d >= c.lower());
      v[i] += (down ? -d : d) * k;
    }
    us.push_back(std::move(v));
  }
  const std::vector<Answer> answers = ask(us, "noise");
  if (!std::all_of(answers.begin(), answers.end(), [](const Answer& a) { return a.ok(); })) return;
  std::vector<double> relative;
  for (Target& t : problem_.targets) {
    std::vector<double> values;
    for (const Answer& a : answers) values.push_back(a.values[t.column]);
    const double noise = difference_noise(values).noise, size = std::abs(values[0]) + t.floor;
    t.model_noise = t.logarithm ? noise / size : noise;
    if (size > 0) relative.push_back(noise / size);
  }
  if (relative.empty()) return;
  std::sort(relative.begin(), relative.end());
  set_noise(std::max(relative[relative.size() * 3 / 4], std::numeric_limits<double>::epsilon()));
}

Derivatives FitModel::derivatives_at(const std::vector<double>& u, bool central, const std::string& what) {
  const std::size_t n = u.size();
  const double h = central ? central_step_ : step_;
  const auto inside = [&](const Neighbour& m) {
    const double v = u[m.parameter] + m.du;
    return v >= coordinates_[m.parameter].lower() && v <= coordinates_[m.parameter].upper();
  };
  std::vector<Neighbour> wanted;
  for (std::size_t i = 0; i < n; ++i) {
    const double d = coordinates_[i].step(u[i], h);
    const Neighbour up{i, d}, down{i, -d};
    if (central || inside(up)) {
      if (inside(up)) wanted.push_back(up);
      if (central && inside(down)) wanted.push_back(down);
    } else if (inside(down)) {
      wanted.push_back(down);
    }
  }
  Derivatives out;
  std::vector<std::vector<double>> us{u};
  for (const Neighbour& m : wanted) us.push_back(moved(u, m));
  std::vector<Eigen::VectorXd> r = residuals_at(us, what);
  out.residuals = r[0];
  out.ok = r[0].size() > 0;
  if (!out.ok) return out;

  struct Known {
    double du;
    Eigen::VectorXd r;
  };
  std::vector<std::vector<Known>> known(n);
  const auto keep = [&](const std::vector<Neighbour>& asked, const std::vector<Eigen::VectorXd>& answers,
                        std::size_t offset) {
    for (std::size_t k = 0; k < asked.size(); ++k)
      if (answers[k + offset].size() > 0) known[asked[k].parameter].push_back({asked[k].du, answers[k + offset]});
  };
  keep(wanted, r, 1);
  for (const double share : {1.0, 0.5}) {
    std::vector<Neighbour> rescue;
    for (std::size_t i = 0; i < n; ++i) {
      if (!known[i].empty()) continue;
      const double d = share * coordinates_[i].step(u[i], h);
      for (const Neighbour& m : {Neighbour{i, d}, Neighbour{i, -d}})
        if (inside(m)) rescue.push_back(m);
    }
    if (rescue.empty()) break;
    us.clear();
    for (const Neighbour& m : rescue) us.push_back(moved(u, m));
    keep(rescue, residuals_at(us, what + ", other side of a point that failed"), 0);
  }

  out.jacobian.setZero(out.residuals.size(), static_cast<Eigen::Index>(n));
  for (std::size_t i = 0; i < n; ++i) {
    auto column = out.jacobian.col(static_cast<Eigen::Index>(i));
    const auto& k = known[i];
    if (k.empty())
      out.frozen.push_back(i);
    else if (k.size() == 1)
      column = (k[0].r - out.residuals) / k[0].du;
    else
      column = (k[0].r - k[1].r) / (k[0].du - k[1].du);
  }
  return out;
}

}  // namespace beltlife
