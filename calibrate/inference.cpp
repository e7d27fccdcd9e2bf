// Intervals from curvature: see inference.h.
#include "calibrate/inference.h"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "sim/eval/student_t.h"

namespace beltlife {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();

/// The local quadratic model of the cost.
struct Curvature {
  Eigen::MatrixXd h;  ///< J^T W J
  Eigen::VectorXd g;  ///< J^T W r
};

Curvature curvature_of(const Derivatives& d, const Eigen::VectorXd& w) {
  const Eigen::MatrixXd wj = w.asDiagonal() * d.jacobian;
  return {d.jacobian.transpose() * wj, wj.transpose() * d.residuals};
}

/// h of the given rows and columns, scaled to a unit diagonal.
Eigen::MatrixXd normalised(const Curvature& c, const std::vector<Eigen::Index>& at) {
  return c.h.diagonal()(at).cwiseSqrt().cwiseInverse().asDiagonal() * c.h(at, at) *
         c.h.diagonal()(at).cwiseSqrt().cwiseInverse().asDiagonal();
}

/// Minimum of the quadratic model over the parameters `at`; flat directions are left alone.
Eigen::VectorXd newton_step(const Curvature& c, const std::vector<Eigen::Index>& at, const Eigen::VectorXd& g) {
  const Eigen::VectorXd scale = c.h.diagonal()(at).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(normalised(c, at));
  Eigen::VectorXd step = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(at.size()));
  const Eigen::VectorXd along = eigen.eigenvectors().transpose() * (scale.asDiagonal() * g(at)).eval();
  for (Eigen::Index k = 0; k < along.size(); ++k)
    if (eigen.eigenvalues()(k) > 1e-12) step -= eigen.eigenvectors().col(k) * (along(k) / eigen.eigenvalues()(k));
  return scale.asDiagonal() * step;
}

/// A place on the way along one parameter: the others go where they cost least.
struct Place {
  std::size_t profile = 0, parameter = 0;
  std::vector<double> u;
  double cost = infinity;
};

/// The profile through pairs of u and cost, that of the fit's end among them.
Profile profile_along(std::vector<std::pair<double, double>> line, double end_u, double end_cost, const Inference& in) {
  std::sort(line.begin(), line.end());
  // Signed root of the likelihood ratio: a straight line where the model is linear.
  const auto root = [&](const std::pair<double, double>& at) {
    const double rise = std::max(at.second - end_cost, 0.0);
    return (at.first < end_u ? -1 : 1) * std::sqrt(2 * rise) / in.scale;
  };
  const auto crossing = [&](double level) {
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const double a = root(line[k]), b = root(line[k + 1]);
      if (std::min(a, b) <= level && level <= std::max(a, b) && a != b)
        return line[k].first + (level - a) / (b - a) * (line[k + 1].first - line[k].first);
    }
    return nan;
  };
  Profile profile;
  profile.low = crossing(-in.quantile);
  profile.high = crossing(in.quantile);
  for (const auto& [u, cost] : line) {
    profile.u.push_back(u);
    profile.cost.push_back(cost);
  }
  return profile;
}

}  // namespace

Inference infer(const FitModel& model, const FitResult& end, double confidence, double loss_scale, bool model_error) {
  const auto& targets = model.problem().targets;
  const auto& coordinates = model.coordinates();
  const auto n = static_cast<Eigen::Index>(coordinates.size());
  const Eigen::VectorXd w = loss_weights(end.end.residuals, targets, loss_scale);
  const Curvature c = curvature_of(end.end, w);
  Inference out;
  out.freedom = static_cast<double>(targets.size()) - static_cast<double>(n);
  const double squares = end.end.residuals.dot(w.asDiagonal() * end.end.residuals);
  out.residual_variance = squares / out.freedom;
  out.quantile = student_t_quantile(confidence, out.freedom);
  out.unexplained = chi_squared_above(squares, out.freedom);
  out.correlation.setIdentity(n, n);
  out.weakest.setZero(n);
  out.share.setZero(n);
  out.standard_error.assign(coordinates.size(), infinity);
  out.standard_error_alone = out.standard_error;
  out.at_bound.assign(coordinates.size(), 0);

  std::vector<Eigen::Index> seen, open;  // parameters that the residuals feel; of them those that may move
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double slack = 1e-9 * (1 + std::abs(end.u[k]));
    if (end.u[k] <= coordinates[k].lower() + slack && c.g(i) > 0) out.at_bound[k] = -1;
    if (end.u[k] >= coordinates[k].upper() - slack && c.g(i) < 0) out.at_bound[k] = 1;
    if (c.h(i, i) <= 0) continue;
    seen.push_back(i);
    if (out.at_bound[k] == 0) open.push_back(i);
  }
  if (seen.empty()) return out;

  const double known = std::sqrt(model_error ? std::max(out.residual_variance, 1.0) : out.residual_variance);
  if (!open.empty()) {
    const Eigen::VectorXd step = newton_step(c, open, c.g);
    out.remaining_cost = -0.5 * c.g(open).dot(step);
    out.remaining = known > 0 ? std::sqrt(std::max(2 * out.remaining_cost, 0.0)) / known : 0;
  }
  out.scale = known * std::sqrt(1 + out.remaining * out.remaining);
  const double s = out.scale;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(normalised(c, seen));
  const Eigen::VectorXd scale = c.h.diagonal()(seen).cwiseSqrt().cwiseInverse();
  const Eigen::VectorXd values = eigen.eigenvalues().cwiseMax(1e-14);
  const Eigen::MatrixXd inverse =
      eigen.eigenvectors() * values.cwiseInverse().asDiagonal() * eigen.eigenvectors().transpose();
  out.eigenvalues.assign(eigen.eigenvalues().data(), eigen.eigenvalues().data() + eigen.eigenvalues().size());
  for (std::size_t a = 0; a < seen.size(); ++a) {
    const auto i = static_cast<Eigen::Index>(a);
    const auto parameter = static_cast<std::size_t>(seen[a]);
    out.standard_error[parameter] = s * scale(i) * std::sqrt(inverse(i, i));
    out.standard_error_alone[parameter] = s * scale(i);
    for (std::size_t b = 0; b < seen.size(); ++b) {
      const auto j = static_cast<Eigen::Index>(b);
      out.correlation(seen[a], seen[b]) = inverse(i, j) / std::sqrt(inverse(i, i) * inverse(j, j));
    }
    out.share(seen[a]) = eigen.eigenvectors()(i, 0);
    out.weakest(seen[a]) = s / std::sqrt(values(0)) * eigen.eigenvectors()(i, 0) * scale(i);
  }
  return out;
}

std::vector<Profile> profiles(FitModel& model, const FitResult& end, const Inference& inference,
                              const std::vector<std::size_t>& which, double loss_scale) {
  const auto& targets = model.problem().targets;
  const auto& coordinates = model.coordinates();
  const Eigen::VectorXd w = loss_weights(end.end.residuals, targets, loss_scale);
  const Curvature c = curvature_of(end.end, w);

  const auto others = [&](std::size_t fixed) {
    std::vector<Eigen::Index> at;
    for (std::size_t i = 0; i < coordinates.size(); ++i)
      if (i != fixed && inference.at_bound[i] == 0 &&
          c.h(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)) > 0)
        at.push_back(static_cast<Eigen::Index>(i));
    return at;
  };
  const auto move = [&](std::vector<double>& u, const std::vector<Eigen::Index>& at, const Eigen::VectorXd& step) {
    for (std::size_t k = 0; k < at.size(); ++k) {
      const auto i = static_cast<std::size_t>(at[k]);
      u[i] = std::clamp(u[i] + step(static_cast<Eigen::Index>(k)), coordinates[i].lower(), coordinates[i].upper());
    }
  };

  std::vector<Place> places;
  for (std::size_t p = 0; p < which.size(); ++p) {
    const std::size_t i = which[p];
    const double reach = inference.quantile * inference.standard_error[i];
    for (const double share : {-1.6, -0.8, 0.8, 1.6}) {
      const double to = std::clamp(end.u[i] + share * reach, coordinates[i].lower(), coordinates[i].upper());
      if (std::abs(to - end.u[i]) < 0.05 * reach) continue;
      Place place{p, i, end.u, infinity};
      place.u[i] = to;
      const auto at = others(i);
      // Where the quadratic model has the others' minimum, given this one's value.
      const Eigen::VectorXd g = c.h.col(static_cast<Eigen::Index>(i)) * (to - end.u[i]);
      if (!at.empty()) move(place.u, at, newton_step(c, at, g));
      if (places.empty() || places.back().u != place.u) places.push_back(std::move(place));
    }
  }
  std::vector<std::vector<double>> us;
  for (const Place& place : places) us.push_back(place.u);
  for (int round = 0; round < 2 && !us.empty(); ++round) {
    const auto residuals = model.residuals_at(us, "profiles");
    for (std::size_t k = 0; k < places.size(); ++k) {
      if (residuals[k].size() == 0) continue;
      const double cost = cost_of(residuals[k], targets, loss_scale);
      if (cost < places[k].cost) {
        places[k].cost = cost;
        places[k].u = us[k];
      }
      const Eigen::VectorXd g =
          end.end.jacobian.transpose() * (loss_weights(residuals[k], targets, loss_scale).asDiagonal() * residuals[k]);
      if (const auto at = others(places[k].parameter); !at.empty()) move(us[k], at, newton_step(c, at, g));
    }
  }

  std::vector<Profile> out;
  for (std::size_t p = 0; p < which.size(); ++p) {
    std::vector<std::pair<double, double>> line{{end.u[which[p]], end.cost}};
    for (const Place& place : places)
      if (place.profile == p && std::isfinite(place.cost)) line.emplace_back(place.u[which[p]], place.cost);
    out.push_back(profile_along(std::move(line), end.u[which[p]], end.cost, inference));
  }
  return out;
}

}  // namespace beltlife
