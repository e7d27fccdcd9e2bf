// Correlations of a study file, checked: see correlation.h.
#include "studies/uncertainty/correlation.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace beltlife {
namespace {

/// One correlation that was understood.
struct Pair {
  std::size_t entry;  ///< of the file's list
  std::size_t a, b;   ///< parameters
};

void refuse(ReadLog& log, std::size_t entry, const char* key, const std::string& what, const std::string& allowed) {
  const SpecPath path = SpecPath{}.child("study").child("correlation").element(entry).child(key);
  log.add(path, log.line(path.place), what, allowed);
}

/// The two parameters of an entry; nothing where it does not name two.
std::vector<std::size_t> named_pair(const CorrelationSpec& c, std::size_t entry,
                                    const std::vector<std::string>& parameters, ReadLog& log) {
  std::vector<std::size_t> at;
  for (const std::string& path : c.between) {
    const auto found = std::find(parameters.begin(), parameters.end(), path);
    if (found == parameters.end()) {
      refuse(log, entry, "between", "no parameter '" + path + "'" + did_you_mean(path, parameters), joined(parameters));
      return {};
    }
    at.push_back(static_cast<std::size_t>(found - parameters.begin()));
  }
  if (at.size() == 2 && at[0] != at[1]) return at;
  refuse(log, entry, "between",
         fmt::format("names {} where a correlation is between two", at.size() == 2 ? "one" : "not two"),
         "paths of two parameters");
  return {};
}

/// Correlations that cannot hold together: the matrix is not positive definite.
void refuse_contradictions(const Rows& rows, const std::vector<Pair>& pairs, ReadLog& log) {
  const auto n = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd matrix(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) matrix(i, j) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(matrix);
  if (eigen.eigenvalues()(0) > 1e-10) return;
  // The one that takes most from the variance of the combination that would have none, or less.
  const Eigen::VectorXd v = eigen.eigenvectors().col(0);
  const auto part = [&](const Pair& p) {
    return v(static_cast<Eigen::Index>(p.a)) * v(static_cast<Eigen::Index>(p.b)) * rows[p.a][p.b];
  };
  const Pair& worst =
      *std::min_element(pairs.begin(), pairs.end(), [&](const Pair& p, const Pair& q) { return part(p) < part(q); });
  refuse(log, worst.entry, "value",
         fmt::format("{} cannot hold beside the other correlations (0 where none is given): their matrix is not "
                     "positive definite, its smallest eigenvalue {:.2g}",
                     rows[worst.a][worst.b], eigen.eigenvalues()(0)),
         "correlations that can hold together");
}

}  // namespace

Rows correlation_of(const std::vector<CorrelationSpec>& stated, const std::vector<std::string>& parameters,
                    ReadLog& log) {
  if (stated.empty()) return {};
  Rows rows(parameters.size(), std::vector<double>(parameters.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i][i] = 1;
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < stated.size(); ++i) {
    const std::vector<std::size_t> at = named_pair(stated[i], i, parameters, log);
    if (at.empty()) continue;
    if (std::any_of(pairs.begin(), pairs.end(),
                    [&](const Pair& p) { return (p.a == at[0] && p.b == at[1]) || (p.a == at[1] && p.b == at[0]); })) {
      refuse(log, i, "between", "stands in an earlier correlation already", "each pair once");
      continue;
    }
    rows[at[0]][at[1]] = rows[at[1]][at[0]] = stated[i].value;
    pairs.push_back({i, at[0], at[1]});
  }
  if (!pairs.empty()) refuse_contradictions(rows, pairs, log);
  return rows;
}

}  // namespace beltlife
