// The module's entry, and distributions and designs by OpenTURNS: see ../openturns_inputs.h.
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <openturns/ComposedDistribution.hxx>
#include <openturns/DistFunc.hxx>
#include <openturns/LHSExperiment.hxx>
#include <openturns/Log.hxx>
#include <openturns/Normal.hxx>
#include <openturns/RandomGenerator.hxx>
#include <openturns/SobolSequence.hxx>
#include <openturns/TBB.hxx>
#include <openturns/Triangular.hxx>
#include <openturns/TruncatedDistribution.hxx>
#include <openturns/Uniform.hxx>

#include "studies/openturns/module/margins.h"

namespace beltlife::openturns {
namespace {

/// Off the faces of the cube, where quantiles are infinite.
double inside(double u) { return std::clamp(u, 0x1p-53, 1 - 0x1p-53); }

Rows rows_of(const OT::Sample& sample) {
  Rows rows(sample.getSize(), std::vector<double>(sample.getDimension()));
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t k = 0; k < rows[i].size(); ++k) rows[i][k] = inside(sample(i, k));
  return rows;
}

OT::Distribution cut_off(const OT::Distribution& whole, std::optional<double> lower, std::optional<double> upper) {
  if (lower && upper) return OT::TruncatedDistribution(whole, *lower, *upper);
  if (lower) return OT::TruncatedDistribution(whole, *lower, OT::TruncatedDistribution::LOWER);
  if (upper) return OT::TruncatedDistribution(whole, *upper, OT::TruncatedDistribution::UPPER);
  return whole;
}

class JointMargins : public Inputs::Margins {
 public:
  JointMargins(const std::vector<ParameterSpec>& parameters, const Rows& correlation) : parameters_(parameters) {
    for (const ParameterSpec& p : parameters) all_.push_back(margin_of(p));
    const auto n = static_cast<Eigen::Index>(correlation.size());
    Eigen::MatrixXd matrix(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j)
        matrix(i, j) = correlation[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    if (n > 0 && !matrix.isIdentity(0)) root_ = matrix.llt().matrixL();
  }
  Rows at(const Rows& unit) const override;

 private:
  std::vector<Margin> all_;
  std::vector<ParameterSpec> parameters_;
  Eigen::MatrixXd root_;  ///< lower Cholesky factor of the correlation; empty: independent
};

}  // namespace

void begin_openturns(std::int64_t seed) {
  OT::TBB::Disable();             // threads are for evaluations
  OT::Log::Show(OT::Log::ERROR);  // of its own bounds for Kriging's lengths it warns every time
  OT::RandomGenerator::SetSeed(static_cast<OT::UnsignedInteger>(seed));
}

Margin margin_of(const ParameterSpec& p) {
  if (!p.distribution) {
    if (p.log) return {OT::Uniform(std::log(*p.lower), std::log(*p.upper)), true};
    return {OT::Uniform(*p.lower, *p.upper), false};
  }
  const DistributionSpec& d = *p.distribution;
  switch (d.kind) {
    case DistributionKind::uniform:
      return {OT::Uniform(*p.lower, *p.upper), false};
    case DistributionKind::triangular:
      return {OT::Triangular(*p.lower, d.mode.value_or(0.5 * (*p.lower + *p.upper)), *p.upper), false};
    case DistributionKind::normal:
      return {cut_off(OT::Normal(*d.mean, *d.standard_deviation), p.lower, p.upper), false};
    case DistributionKind::lognormal:
      break;
  }
  const double relative = *d.standard_deviation / *d.mean, variance = std::log1p(relative * relative);
  const auto logarithm = [](std::optional<double> bound) {
    return bound && *bound > 0 ? std::optional(std::log(*bound)) : std::nullopt;
  };
  const OT::Normal whole(std::log(*d.mean) - 0.5 * variance, std::sqrt(variance));
  return {cut_off(whole, logarithm(p.lower), logarithm(p.upper)), true};
}

Rows design(SamplingMethod method, std::size_t rows, std::size_t columns, std::int64_t seed) {
  begin_openturns(seed);
  if (method == SamplingMethod::lhs) {
    const OT::ComposedDistribution cube(OT::ComposedDistribution::DistributionCollection(columns, OT::Uniform(0, 1)));
    return rows_of(OT::LHSExperiment(cube, rows, true, true).generate());
  }
  const bool random = method == SamplingMethod::monte_carlo;
  OT::Sample sample = random ? OT::Sample(rows, columns) : OT::SobolSequence(columns).generate(rows);
  std::vector<double> shift(columns);
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t k = 0; k < columns; ++k) {
      if (random || i == 0) shift[k] = OT::RandomGenerator::Generate();
      const double moved = sample(i, k) + shift[k];
      sample(i, k) = moved - std::floor(moved);
    }
  return rows_of(sample);
}

std::shared_ptr<const Inputs::Margins> margins(const std::vector<ParameterSpec>& parameters, const Rows& correlation) {
  begin_openturns(0);
  return std::make_shared<JointMargins>(parameters, correlation);
}

Rows JointMargins::at(const Rows& unit) const {
  Rows rows = unit;
  for (std::vector<double>& row : rows) {
    if (root_.size() > 0) {
      Eigen::VectorXd scores(static_cast<Eigen::Index>(row.size()));
      for (std::size_t k = 0; k < row.size(); ++k) scores(static_cast<Eigen::Index>(k)) = OT::DistFunc::qNormal(row[k]);
      scores = root_ * scores;
      for (std::size_t k = 0; k < row.size(); ++k)
        row[k] = inside(OT::DistFunc::pNormal(scores(static_cast<Eigen::Index>(k))));
    }
    for (std::size_t k = 0; k < row.size(); ++k) {
      const Margin& margin = all_[k];
      const ParameterSpec& p = parameters_[k];
      row[k] = margin.distribution.computeQuantile(row[k])[0];
      if (margin.logarithm) row[k] = std::exp(row[k]);
      // A rounding beyond a bound would be a refused point.
      if (p.lower) row[k] = std::max(row[k], *p.lower);
      if (p.upper) row[k] = std::min(row[k], *p.upper);
    }
  }
  return rows;
}

}  // namespace beltlife::openturns

const beltlife::OpenTurnsModule* beltlife::beltlife_openturns_module() {
  static constexpr OpenTurnsModule table{openturns::design, openturns::margins, openturns::chaos, openturns::kriging};
  return &table;
}
