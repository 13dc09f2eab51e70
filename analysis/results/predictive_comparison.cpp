#include "analysis/results/predictive_comparison.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "analysis/results/published_statistics.h"
#include "analysis/statistics/distributions.h"
#include "analysis/statistics/summary.h"
#include "core/error.h"
#include "core/random_stream.h"

namespace jnd::analysis {
namespace {

using ByCell = std::map<std::string, std::vector<std::size_t>>;

/// Draws `number` people in random order, evenly over the cells. The cells that get one more,
/// and the people within a cell, are drawn.
std::vector<std::size_t> balanced_draw(ByCell by_cell, std::size_t number,
                                       core::RandomStream& random) {
  std::vector<std::string> cells;
  for (auto& [cell, places] : by_cell) {
    random.shuffle(places);
    cells.push_back(cell);
  }
  std::vector<std::size_t> drawn;
  while (drawn.size() < number) {
    random.shuffle(cells);
    for (const std::string& cell : cells) {
      std::vector<std::size_t>& left = by_cell[cell];
      if (left.empty() || drawn.size() == number) continue;
      drawn.push_back(left.back());
      left.pop_back();
    }
  }
  random.shuffle(drawn);
  return drawn;
}

/// Rounds to the decimals that were printed, so that both values are equally coarse.
double rounded(double value, const std::optional<int>& num_decimals) {
  if (!num_decimals || !std::isfinite(value)) return value;
  const double scale = std::pow(10.0, *num_decimals);
  return std::round(value * scale) / scale;
}

/// Normal scores of midranks at (rank - 1/2) / number.
Eigen::VectorXd normal_scores(const std::vector<double>& values) {
  const std::size_t num = values.size();
  std::vector<std::size_t> order(num);
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
  Eigen::VectorXd scores(static_cast<Eigen::Index>(num));
  for (std::size_t first = 0; first < num;) {
    std::size_t end = first;
    while (end < num && values[order[end]] == values[order[first]]) ++end;
    const double middle = 0.5 * static_cast<double>(first + end) / static_cast<double>(num);
    for (std::size_t i = first; i < end; ++i) {
      scores[static_cast<Eigen::Index>(order[i])] = normal_quantile(middle);
    }
    first = end;
  }
  return scores;
}

/// The squared Mahalanobis distance of each row from the mean. Directions without variation are
/// ignored.
Eigen::VectorXd distances(Eigen::MatrixXd scores) {
  scores.rowwise() -= scores.colwise().mean().eval();
  const Eigen::MatrixXd covariance =
      scores.transpose() * scores / static_cast<double>(scores.rows());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance);
  constexpr double kNothing = 1e-9;
  const Eigen::VectorXd inverse = solver.eigenvalues().unaryExpr(
      [](double variance) { return variance > kNothing ? 1.0 / variance : 0.0; });
  const Eigen::MatrixXd turned = scores * solver.eigenvectors();
  return turned.cwiseAbs2() * inverse;
}

}  // namespace

PredictiveStudies::PredictiveStudies(const PredictivePeople& people, int num_participants,
                                     int num_studies)
    : num_groups_(people.groups.size()) {
  const auto size = static_cast<std::size_t>(std::max(num_participants, 0));
  for (const auto& group : people.groups) {
    if (size < 1 || group.size() < size) {
      throw core::Error("simulated people: expected groups of at least " +
                        std::to_string(num_participants) + ", found one of " +
                        std::to_string(group.size()));
    }
  }
  for (std::size_t group = 0; group < num_groups_; ++group) {
    ByCell by_cell;
    for (const PersonOutcome& person : people.groups[group]) {
      by_cell[person.cells].push_back(everybody_.size());
      everybody_.push_back(person);
    }
    const std::size_t first = group * static_cast<std::size_t>(num_studies) / num_groups_;
    const std::size_t end = (group + 1) * static_cast<std::size_t>(num_studies) / num_groups_;
    for (std::size_t i = first; i < end; ++i) {
      core::RandomStream random(people.seed, "predictive study",
                                {static_cast<std::int64_t>(i)});
      drawn_.push_back({group, balanced_draw(by_cell, size, random)});
    }
  }
}

const PredictiveStudies::Values& PredictiveStudies::values_of(
    const PublishedValue& published) const {
  const auto n = static_cast<std::size_t>(published.n.value_or(0));
  const auto known = std::ranges::find_if(known_, [&](const Known& one) {
    return one.statistic == *published.compute && one.num_participants == n;
  });
  if (known != known_.end()) return known->values;
  Values values;
  for (const Draw& draw : drawn_) {
    std::vector<std::size_t> places = draw.places;
    if (n > 0 && n < places.size()) places.resize(n);
    values.push_back(statistics_.value(*published.compute, places));
  }
  known_.push_back({*published.compute, n, std::move(values)});
  return known_.back().values;
}

double PredictiveStudies::standard_error(const std::vector<bool>& counted) const {
  std::vector<double> num_counted(num_groups_), num_all(num_groups_);
  for (std::size_t i = 0; i < drawn_.size(); ++i) {
    num_counted[drawn_[i].group] += counted[i] ? 1.0 : 0.0;
    num_all[drawn_[i].group] += 1.0;
  }
  std::vector<double> shares;
  for (std::size_t group = 0; group < num_groups_; ++group) {
    if (num_all[group] > 0.0) shares.push_back(num_counted[group] / num_all[group]);
  }
  return summary_of(shares).standard_deviation.value_or(0.0) /
         std::sqrt(static_cast<double>(shares.size()));
}

std::optional<PredictiveTail> PredictiveStudies::tail_of(
    const PublishedValue& published) const {
  if (!published.value || !published.compute) return std::nullopt;
  PredictiveTail tail;
  std::vector<bool> below, above;
  for (const std::optional<double>& value : values_of(published)) {
    below.push_back(value && rounded(*value, published.num_decimals) <= *published.value);
    above.push_back(value && rounded(*value, published.num_decimals) >= *published.value);
    if (value) tail.values.push_back(*value);
  }
  if (2 * tail.values.size() < drawn_.size()) return std::nullopt;
  const auto share = [&](const std::vector<bool>& counted) {
    return static_cast<double>(std::ranges::count(counted, true)) /
           static_cast<double>(tail.values.size());
  };
  tail.is_below = share(below) < share(above);
  tail.tail = std::min(share(below), share(above));
  tail.standard_error = standard_error(tail.is_below ? below : above);
  tail.p_value = std::min(1.0, 2.0 * tail.tail);
  std::vector<double> ascending = tail.values;
  std::ranges::sort(ascending);
  tail.median = percentile(ascending, 0.5);
  tail.low = percentile(ascending, 0.025);
  tail.high = percentile(ascending, 0.975);
  return tail;
}

std::optional<JointTail> PredictiveStudies::joint_tail(
    const std::vector<PublishedValue>& published) const {
  std::vector<std::vector<double>> columns;
  std::vector<bool> is_whole(drawn_.size(), true);
  for (const PublishedValue& one : published) {
    if (!one.value || !one.compute || one.follows_from_others) continue;
    std::vector<double>& column = columns.emplace_back();
    const Values& values = values_of(one);
    for (std::size_t i = 0; i < values.size(); ++i) {
      is_whole[i] = is_whole[i] && values[i].has_value();
      column.push_back(rounded(values[i].value_or(0.0), one.num_decimals));
    }
    column.push_back(*one.value);
  }
  const auto num_whole = std::ranges::count(is_whole, true);
  if (columns.empty() || 2 * static_cast<std::size_t>(num_whole) < drawn_.size()) {
    return std::nullopt;
  }
  Eigen::MatrixXd scores(num_whole + 1, static_cast<Eigen::Index>(columns.size()));
  for (std::size_t place = 0; place < columns.size(); ++place) {
    std::vector<double> kept;
    for (std::size_t i = 0; i < drawn_.size(); ++i) {
      if (is_whole[i]) kept.push_back(columns[place][i]);
    }
    kept.push_back(columns[place].back());
    scores.col(static_cast<Eigen::Index>(place)) = normal_scores(kept);
  }
  const Eigen::VectorXd squared = distances(std::move(scores));
  std::vector<bool> as_far;
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < drawn_.size(); ++i) {
    as_far.push_back(is_whole[i] && squared[row++] >= squared[num_whole]);
  }
  // The published study counts as one of them, because a share of 0 would claim too much.
  const auto num_as_far = static_cast<double>(std::ranges::count(as_far, true));
  return JointTail{.num_statistics = static_cast<int>(columns.size()),
                   .p_value = (num_as_far + 1.0) / (static_cast<double>(num_whole) + 1.0),
                   .standard_error = standard_error(as_far)};
}

}  // namespace jnd::analysis
