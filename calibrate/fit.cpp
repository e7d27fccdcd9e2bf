// The fit by Ceres: see fit.h. The only includer of Ceres.
#include "calibrate/fit.h"

#include <ceres/ceres.h>
#include <fmt/format.h>

#include <exception>
#include <limits>
#include <memory>

namespace beltlife {
namespace {

/// Null for none. A residual block owns what it gets.
ceres::LossFunction* loss_of(Loss loss, double scale) {
  switch (loss) {
    case Loss::huber:
      return new ceres::HuberLoss(scale);
    case Loss::soft_l1:
      return new ceres::SoftLOneLoss(scale);
    case Loss::cauchy:
      return new ceres::CauchyLoss(scale);
    case Loss::none:
      break;
  }
  return nullptr;
}

/// Evaluates all residuals at once where Ceres would ask for one after another.
class Batch final : public ceres::EvaluationCallback {
 public:
  Batch(FitModel& model, const std::vector<double>& u, bool central, std::string what)
      : model_(model), u_(u), central_(central), what_(std::move(what)) {}

  void PrepareForEvaluation(bool jacobians, bool fresh) final {
    if (error) {
      now.ok = false;
      return;
    }
    if (!fresh && (!jacobians || now.jacobian.size() > 0)) return;
    try {
      if (jacobians || model_.problem().together) {
        now = model_.derivatives_at(u_, central_, what());
      } else {
        now = {};
        now.residuals = model_.residuals_at({u_}, what())[0];
        now.ok = now.residuals.size() > 0;
      }
    } catch (...) {  // not through Ceres; fit() throws it again
      error = std::current_exception();
      now.ok = false;
    }
  }

  Derivatives now;
  std::exception_ptr error;
  double cost = std::numeric_limits<double>::quiet_NaN();  ///< lowest so far, for whoever waits

 private:
  std::string what() const { return std::isnan(cost) ? what_ : fmt::format("{}, cost {:.4g}", what_, cost); }

  FitModel& model_;
  const std::vector<double>& u_;
  bool central_;
  std::string what_;
};

/// One residual, read off the batch.
class Residual final : public ceres::CostFunction {
 public:
  Residual(const Batch& batch, std::size_t row, std::size_t parameters)
      : batch_(batch), row_(static_cast<Eigen::Index>(row)) {
    set_num_residuals(1);
    mutable_parameter_block_sizes()->push_back(static_cast<int>(parameters));
  }
  bool Evaluate(double const* const*, double* residuals, double** jacobians) const final {
    if (!batch_.now.ok) return false;
    residuals[0] = batch_.now.residuals(row_);
    if (jacobians && jacobians[0])
      for (Eigen::Index i = 0; i < parameter_block_sizes()[0]; ++i) jacobians[0][i] = batch_.now.jacobian(row_, i);
    return true;
  }

 private:
  const Batch& batch_;
  Eigen::Index row_;
};

/// Parameters on a bound beyond which the cost would fall.
std::vector<int> pressed(const FitModel& model, const Derivatives& d, const std::vector<double>& u, bool robust,
                         double loss_scale) {
  Eigen::VectorXd slope = d.residuals;
  if (robust) slope.array() *= loss_weights(d.residuals, model.problem().targets, loss_scale).array();
  slope = (d.jacobian.transpose() * slope).eval();
  std::vector<int> out;
  for (std::size_t i = 0; i < u.size(); ++i) {
    const double g = slope(static_cast<Eigen::Index>(i));
    if ((u[i] <= model.coordinates()[i].lower() && g > 0) || (u[i] >= model.coordinates()[i].upper() && g < 0))
      out.push_back(static_cast<int>(i));
  }
  return out;
}

/// Ends a pass also where other parameters than those held have been pressed against a bound for two steps: Ceres cuts
/// steps off at bounds after it has computed them, so that the others' share of them is wrong and the fit creeps.
class Watch final : public ceres::IterationCallback {
 public:
  Watch(const FitModel& model, const FitOptions& options, std::vector<CostStep>& steps, Batch& batch,
        const std::vector<double>& u, const std::vector<int>& held, bool robust)
      : model_(model), options_(options), steps_(steps), batch_(batch), u_(u), held_(held), robust_(robust) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& s) final {
    if (s.step_is_successful) {
      steps_.push_back({model_.points(), s.cost});
      batch_.cost = s.cost;
    }
    if (batch_.error) return ceres::SOLVER_ABORT;
    if (model_.points() >= options_.budget) {
      spent = true;
      return ceres::SOLVER_TERMINATE_SUCCESSFULLY;
    }
    if (s.step_is_successful && batch_.now.jacobian.size() > 0) {
      const std::vector<int> now = pressed(model_, batch_.now, u_, robust_, options_.loss_scale);
      lasting_ = now != held_ && now == before_ ? lasting_ + 1 : 0;
      before_ = now;
    }
    return lasting_ > 0 ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }
  bool spent = false;

 private:
  const FitModel& model_;
  const FitOptions& options_;
  std::vector<CostStep>& steps_;
  Batch& batch_;
  const std::vector<double>& u_;
  const std::vector<int>& held_;
  bool robust_;
  std::vector<int> before_;
  int lasting_ = 0;
};

std::string words_of(const ceres::Solver::Summary& summary, bool spent, int iterations) {
  if (spent) return "the budget of points is spent";
  switch (summary.termination_type) {
    case ceres::CONVERGENCE:
      return "the cost changes no more";
    case ceres::NO_CONVERGENCE:
      return static_cast<int>(summary.iterations.size()) > iterations ? "the iterations allowed are spent"
                                                                      : "no step lowers the cost any more";
    default:
      return "every step tried failed";
  }
}

/// One pass with some parameters held; returns false if the start has no residuals.
bool pass(FitModel& model, std::vector<double>& u, const std::vector<int>& held, bool central, bool robust,
          const FitOptions& o, const std::string& what, FitResult& result) {
  const auto& targets = model.problem().targets;
  const auto& coordinates = model.coordinates();
  std::vector<double> x = u;
  Batch batch(model, x, central, what);
  ceres::Problem::Options of_problem;
  of_problem.evaluation_callback = &batch;
  ceres::Problem problem(of_problem);
  problem.AddParameterBlock(x.data(), static_cast<int>(x.size()));
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (std::isfinite(coordinates[i].lower()))
      problem.SetParameterLowerBound(x.data(), static_cast<int>(i), coordinates[i].lower());
    if (std::isfinite(coordinates[i].upper()))
      problem.SetParameterUpperBound(x.data(), static_cast<int>(i), coordinates[i].upper());
  }
  if (!held.empty()) problem.SetManifold(x.data(), new ceres::SubsetManifold(static_cast<int>(x.size()), held));
  for (std::size_t k = 0; k < targets.size(); ++k)
    problem.AddResidualBlock(new Residual(batch, k, x.size()),
                             loss_of(robust ? targets[k].loss : Loss::none, o.loss_scale), x.data());

  ceres::Solver::Options options;
  options.num_threads = 1;  // with more the cost moves by a bit
  options.logging_type = ceres::SILENT;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = o.iterations;
  options.function_tolerance = o.tolerance;
  options.gradient_tolerance = 0;
  options.parameter_tolerance = std::min(1e-4 * std::sqrt(o.tolerance), 1e-8);
  // With bounds Ceres would search along each step, with derivatives at every point of the search.
  options.max_num_line_search_step_size_iterations = 0;
  Watch watch(model, o, result.steps, batch, x, held, robust);
  options.callbacks.push_back(&watch);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (batch.error) std::rethrow_exception(batch.error);
  result.ended = words_of(summary, watch.spent, o.iterations);
  result.at_rest = !watch.spent && summary.termination_type == ceres::CONVERGENCE;
  if (summary.iterations.empty() || !summary.IsSolutionUsable()) return false;
  u = x;
  return true;
}

/// Passes until the parameters held are those that are pressed against a bound.
void passes(FitModel& model, bool central, bool robust, const FitOptions& o, const std::string& what,
            FitResult& result) {
  std::vector<int> held;
  for (std::size_t round = 0; round < 2 * result.u.size() + 2; ++round) {
    if (held.size() < result.u.size() && !pass(model, result.u, held, central, robust, o, what, result)) return;
    const Derivatives d = model.derivatives_at(result.u, central, what);
    if (!d.ok || model.points() >= o.budget) return;
    std::vector<int> now = pressed(model, d, result.u, robust, o.loss_scale);
    if (now == held) {
      if (held.size() == result.u.size()) result.ended = "every parameter is on a bound";
      return;
    }
    held = std::move(now);
  }
  result.ended = "parameters go from bound to bound";
}

}  // namespace

double cost_of(const Eigen::VectorXd& r, const std::vector<Target>& targets, double scale, bool robust) {
  double sum = 0;
  for (std::size_t k = 0; k < targets.size(); ++k) {
    const double s = r(static_cast<Eigen::Index>(k)) * r(static_cast<Eigen::Index>(k));
    double rho[3] = {s, 1, 0};
    if (!robust) {
      sum += 0.5 * s;
      continue;
    }
    if (const std::unique_ptr<ceres::LossFunction> loss{loss_of(targets[k].loss, scale)}) loss->Evaluate(s, rho);
    sum += 0.5 * rho[0];
  }
  return sum;
}

Eigen::VectorXd loss_weights(const Eigen::VectorXd& r, const std::vector<Target>& targets, double scale) {
  Eigen::VectorXd w = Eigen::VectorXd::Ones(r.size());
  for (std::size_t k = 0; k < targets.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    double rho[3] = {0, 1, 0};
    if (const std::unique_ptr<ceres::LossFunction> loss{loss_of(targets[k].loss, scale)})
      loss->Evaluate(r(i) * r(i), rho);
    w(i) = rho[1];
  }
  return w;
}

FitResult fit(FitModel& model, std::vector<double> start, Differences differences, bool robust, const FitOptions& o,
              const std::string& what) {
  const bool central = differences == Differences::central;
  const auto& targets = model.problem().targets;
  FitResult result;
  result.u = std::move(start);
  result.end = model.derivatives_at(result.u, central, what);
  if (!result.end.ok) {
    result.ended = "the start has no residuals: the model failed there";
    return result;
  }
  result.start_cost = cost_of(result.end.residuals, targets, o.loss_scale, robust);
  passes(model, central, robust, o, what, result);
  result.end = model.derivatives_at(result.u, central, what + ", end");
  result.ok = result.end.ok;
  if (result.ok) result.cost = cost_of(result.end.residuals, targets, o.loss_scale, robust);
  return result;
}

}  // namespace beltlife
