// Owns what the kinds of study that sample their parameters share: their checks, their columns, values by quantity.
#pragma once

#include "results/course/study_run.h"
#include "studies/sample.h"

namespace beltlife {

/// What is recorded where a study file names nothing: the life, as its logarithm.
std::vector<std::string> life_quantity(const Model& model);

/// Adds what keeps the parameters from being sampled: none at all, or one with neither a distribution nor both bounds.
void check_scatter(const ProblemSpec& problem, ReadLog& log);
/// The same where a kind looks at the range between the bounds alone: they must be there, whatever the distribution.
void check_bounds(const ProblemSpec& problem, ReadLog& log);

StudyHead sampled_head(const LoadedProblem& problem);
PointModel sampled_model(const LoadedProblem& problem, int threads);

std::vector<Point> points_of(const Rows& rows);

/// Values of one quantity where all points of a group are ok, a row a group of `size` points that follow each other.
Rows whole_groups(const std::vector<Answer>& answers, std::size_t size, std::size_t quantity);

/// A number of an answer in `digits` digits, "-" where it is not known.
std::string cell(double number, int digits);

/// " in UNIT" by the name of a quantity, empty if it has none.
std::string in_unit(const std::string& quantity);

}  // namespace beltlife
