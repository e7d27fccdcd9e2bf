// Surrogates, by OpenTURNS: see ../openturns_surrogate.h.
#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <openturns/ComposedDistribution.hxx>
#include <openturns/ConstantBasisFactory.hxx>
#include <openturns/CorrectedLeaveOneOut.hxx>
#include <openturns/FixedStrategy.hxx>
#include <openturns/FunctionalChaosAlgorithm.hxx>
#include <openturns/KrigingAlgorithm.hxx>
#include <openturns/LARS.hxx>
#include <openturns/LeastSquaresMetaModelSelectionFactory.hxx>
#include <openturns/LeastSquaresStrategy.hxx>
#include <openturns/LinearEnumerateFunction.hxx>
#include <openturns/MaternModel.hxx>
#include <openturns/OrthogonalProductPolynomialFactory.hxx>

#include "studies/openturns/module/margins.h"
#include "studies/uncertainty/order_statistics.h"

namespace beltlife::openturns {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

using Margins = std::vector<Margin>;

Margins margins_of(const std::vector<ParameterSpec>& parameters) {
  Margins margins;
  for (const ParameterSpec& p : parameters) margins.push_back(margin_of(p));
  return margins;
}

/// A point on the scales of the margins; of Kriging, in their standard deviations about their means.
OT::Point scaled(const Margins& margins, const std::vector<double>& at, bool standardised) {
  OT::Point t(at.size());
  for (std::size_t k = 0; k < at.size(); ++k) {
    t[k] = margins[k].scale_of(at[k]);
    if (!standardised) continue;
    const OT::Distribution& d = margins[k].distribution;
    t[k] = (t[k] - d.getMean()[0]) / d.getStandardDeviation()[0];
  }
  return t;
}

OT::Sample scaled(const Margins& margins, const Rows& at, bool standardised) {
  OT::Sample sample(at.size(), margins.size());
  for (std::size_t i = 0; i < at.size(); ++i) sample[i] = scaled(margins, at[i], standardised);
  return sample;
}

/// Values in standard deviations about their mean.
OT::Sample standardised(const std::vector<double>& values, const Moments& m) {
  OT::Sample sample(values.size(), 1);
  for (std::size_t i = 0; i < values.size(); ++i) sample(i, 0) = (values[i] - m.mean) / m.standard_deviation;
  return sample;
}

Eigen::VectorXd vector_of(const OT::Sample& y) {
  Eigen::VectorXd v(static_cast<Eigen::Index>(y.getSize()));
  for (std::size_t i = 0; i < y.getSize(); ++i) v(static_cast<Eigen::Index>(i)) = y(i, 0);
  return v;
}

/// 1 - mean square error / variance, of values of variance 1.
double q2_of(const Eigen::VectorXd& errors) {
  return 1 - errors.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(errors.size() - 1, 1));
}

Surrogate constant(double value) {
  Surrogate s{none, 1, {}, {}, {}};
  s.predict = [value](const std::vector<double>&) { return value; };
  return s;
}

bool varies(const Moments& m) { return m.standard_deviation > 1e-13 * std::abs(m.mean); }

/// Values of orthogonal polynomials at points, a row a point.
Eigen::MatrixXd values_of(const std::vector<OT::Function>& terms, const OT::Sample& at) {
  Eigen::MatrixXd values(static_cast<Eigen::Index>(at.getSize()), static_cast<Eigen::Index>(terms.size()));
  for (std::size_t k = 0; k < terms.size(); ++k) values.col(static_cast<Eigen::Index>(k)) = vector_of(terms[k](at));
  return values;
}

/// Errors of least squares if each point is left out in turn: r / (1 - h), h the diagonal of the projection.
Eigen::VectorXd errors_left_out(const Eigen::HouseholderQR<Eigen::MatrixXd>& fit, const Eigen::VectorXd& y) {
  const auto rows = fit.rows();
  const Eigen::MatrixXd q = fit.householderQ() * Eigen::MatrixXd::Identity(rows, fit.cols());
  const Eigen::VectorXd left = y - q * (q.transpose() * y);
  return left.cwiseQuotient((Eigen::VectorXd::Ones(rows) - q.rowwise().squaredNorm()).cwiseMax(1e-12));
}

/// The same of ordinary Kriging (Dubrule, Math. Geol. 15, 1983): Q y / diag Q, Q the inverse covariance freed of the
/// constant.
Eigen::VectorXd errors_left_out(const OT::CovarianceModel& model, const OT::Sample& at, const Eigen::VectorXd& y) {
  const OT::CovarianceMatrix covariance = model.discretize(at);
  Eigen::MatrixXd k(y.size(), y.size());
  for (Eigen::Index i = 0; i < y.size(); ++i)
    for (Eigen::Index j = 0; j < y.size(); ++j)
      k(i, j) = covariance(static_cast<OT::UnsignedInteger>(i), static_cast<OT::UnsignedInteger>(j));
  const Eigen::MatrixXd inverse = k.llt().solve(Eigen::MatrixXd::Identity(y.size(), y.size()));
  const Eigen::VectorXd ones = inverse.rowwise().sum();
  const Eigen::MatrixXd q = inverse - ones * ones.transpose() / ones.sum();
  return (q * y).cwiseQuotient(q.diagonal());
}

}  // namespace

Surrogate chaos(const std::vector<ParameterSpec>& parameters, const Rows& at, const std::vector<double>& values,
                int degree) {
  begin_openturns(0);
  const Moments m = moments_of(values);
  if (!varies(m)) return constant(m.mean);
  const Margins margins = margins_of(parameters);
  OT::ComposedDistribution::DistributionCollection distributions;
  for (const Margin& margin : margins) distributions.add(margin.distribution);
  const OT::LinearEnumerateFunction order(parameters.size());
  const OT::OrthogonalProductPolynomialFactory basis(distributions, order);
  const OT::UnsignedInteger terms = order.getStrataCumulatedCardinal(static_cast<OT::UnsignedInteger>(degree));
  const OT::Sample x = scaled(margins, at, false), y = standardised(values, m);
  OT::FunctionalChaosAlgorithm algorithm(
      x, y, OT::ComposedDistribution(distributions), OT::FixedStrategy(basis, terms),
      OT::LeastSquaresStrategy(OT::LeastSquaresMetaModelSelectionFactory(OT::LARS(), OT::CorrectedLeaveOneOut())));
  algorithm.run();
  const OT::FunctionalChaosResult result = algorithm.getResult();

  // Of the result only which terms were taken: getSobolTotalIndex() of OpenTURNS 1.20 gives totals below first indices.
  const OT::Indices taken = result.getIndices();
  std::vector<OT::Function> polynomials;
  for (const OT::UnsignedInteger index : taken) polynomials.push_back(basis.build(index));
  const OT::Function onto = result.getTransformation();
  const Eigen::VectorXd wanted = vector_of(y);
  const Eigen::HouseholderQR<Eigen::MatrixXd> fit(values_of(polynomials, onto(x)));
  const Eigen::VectorXd coefficients = fit.solve(wanted);

  Surrogate s;
  s.q2 = q2_of(errors_left_out(fit, wanted));
  s.terms = taken.getSize();
  // The polynomials are orthonormal: a squared coefficient is the variance of its term (Sudret, Reliab. Eng. Syst. Saf.
  // 93, 2008).
  std::vector<double> alone(parameters.size()), any(parameters.size());
  double variance = 0;
  for (std::size_t k = 0; k < polynomials.size(); ++k) {
    const OT::Indices degrees = order(taken[k]);
    const double part = std::pow(coefficients(static_cast<Eigen::Index>(k)), 2);
    std::vector<std::size_t> in;
    for (std::size_t p = 0; p < parameters.size(); ++p)
      if (degrees[p] > 0) in.push_back(p);
    if (in.empty()) continue;
    variance += part;
    for (const std::size_t p : in) any[p] += part;
    if (in.size() == 1) alone[in[0]] += part;
  }
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    s.first.push_back(variance > 0 ? alone[p] / variance : none);
    s.total.push_back(variance > 0 ? any[p] / variance : none);
  }
  s.predict = [margins, m, onto, polynomials, coefficients](const std::vector<double>& p) {
    OT::Sample at(1, p.size());
    at[0] = onto(scaled(margins, p, false));
    return m.mean + m.standard_deviation * values_of(polynomials, at).row(0).dot(coefficients);
  };
  return s;
}

Surrogate kriging(const std::vector<ParameterSpec>& parameters, const Rows& at, const std::vector<double>& values) {
  begin_openturns(0);
  const Moments m = moments_of(values);
  if (!varies(m)) return constant(m.mean);
  const Margins margins = margins_of(parameters);
  const OT::UnsignedInteger d = parameters.size();
  const OT::Sample x = scaled(margins, at, true), y = standardised(values, m);
  Surrogate best;
  best.q2 = -std::numeric_limits<double>::infinity();
  // Lengths by likelihood; the nugget, which its surface shows poorly, is the one of these that foretells best.
  for (const double nugget : {1e-8, 1e-4, 1e-2, 1e-1}) {
    OT::MaternModel covariance(OT::Point(d, 1.0), OT::Point(1, 1.0), 2.5);
    covariance.setNuggetFactor(nugget);
    OT::KrigingAlgorithm algorithm(x, y, covariance, OT::ConstantBasisFactory(d).build());
    algorithm.setOptimizationBounds(OT::Interval(OT::Point(d, 0.1), OT::Point(d, 30.0)));
    algorithm.run();
    const OT::KrigingResult result = algorithm.getResult();
    const double q2 = q2_of(errors_left_out(result.getCovarianceModel(), x, vector_of(y)));
    if (!(q2 > best.q2)) continue;
    best.q2 = q2;
    best.terms = d + 2;
    best.predict = [margins, m, model = result.getMetaModel()](const std::vector<double>& p) {
      return m.mean + m.standard_deviation * model(scaled(margins, p, true))[0];
    };
  }
  return best;
}

}  // namespace beltlife::openturns
