#include "analysis/mixed/mixed_likelihood.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.h"

namespace jnd::analysis {
namespace {

constexpr std::size_t kMostGridNodes = 100'000;

/// The structure of the information: the columns of the corner in which each group of the first
/// grouping has rows.
ArrowMatrix information_of(const MixedModel& model) {
  const MixedGrouping& first = model.groupings.front();
  std::vector<std::set<int>> touched(first.num_groups);
  int begin = 0;
  for (std::size_t k = 1; k < model.groupings.size(); ++k) {
    const MixedGrouping& grouping = model.groupings[k];
    const int num = grouping.num_effects();
    for (std::size_t row = 0; row < model.num_rows(); ++row) {
      for (int i = 0; i < num; ++i) {
        touched[first.group[row]].insert(begin + static_cast<int>(grouping.group[row]) * num +
                                         i);
      }
    }
    begin += static_cast<int>(grouping.num_groups) * num;
  }
  std::vector<std::vector<int>> columns;
  for (const std::set<int>& one : touched) columns.emplace_back(one.begin(), one.end());
  return {first.num_effects(), begin, std::move(columns)};
}

GaussHermiteGrid grid_of(const MixedModel& model, int num_nodes) {
  if (num_nodes == 1) return {};
  if (model.groupings.size() > 1) {
    throw core::Error("expected one grouping for quadrature, found " +
                      std::to_string(model.groupings.size()) +
                      "; one node, Laplace's approximation, has no such bound");
  }
  const int num_effects = model.groupings.front().num_effects();
  if (num_effects > kMostRandomEffects ||
      std::pow(num_nodes, num_effects) > static_cast<double>(kMostGridNodes)) {
    throw core::Error("expected a grid of at most 100000 nodes in five dimensions, found " +
                      std::to_string(num_nodes) + " nodes in " + std::to_string(num_effects) +
                      " dimensions; take fewer nodes");
  }
  return gauss_hermite_grid(num_nodes, num_effects);
}

}  // namespace

MixedLikelihood::MixedLikelihood(const MixedModel& model, int num_nodes)
    : model_(model),
      grid_(grid_of(model, num_nodes)),
      num_nodes_(num_nodes),
      num_parameters_(model.num_parameters()),
      information_(information_of(model)) {
  const MixedGrouping& first = model.groupings.front();
  head_size_ = first.num_effects();
  for (std::size_t k = 1; k < model.groupings.size(); ++k) {
    tail_size_ += model.groupings[k].num_effects();
  }
  const std::size_t num_rows = model.num_rows();
  group_begin_.assign(first.num_groups + 1, num_rows);
  for (std::size_t row = num_rows; row-- > 0;) group_begin_[first.group[row]] = row;
  for (std::size_t g = first.num_groups; g-- > 0;) {
    group_begin_[g] = std::min(group_begin_[g], group_begin_[g + 1]);
  }
  for (std::size_t row = 0; row < num_rows; ++row) {
    int begin = 0;
    for (std::size_t k = 1; k < model.groupings.size(); ++k) {
      const MixedGrouping& grouping = model.groupings[k];
      for (int i = 0; i < grouping.num_effects(); ++i) {
        columns_.push_back(begin +
                           static_cast<int>(grouping.group[row]) * grouping.num_effects() + i);
        places_.push_back(information_.place_in(first.group[row], columns_.back()));
      }
      begin += static_cast<int>(grouping.num_groups) * grouping.num_effects();
    }
  }
  const auto rows = static_cast<Eigen::Index>(num_rows);
  m_.resize(rows, head_size_ + tail_size_);
  modes_ = Eigen::VectorXd::Zero(information_.size());
  for (Eigen::VectorXd* one : {&rows_.score, &rows_.observed, &rows_.expected, &rows_.drift}) {
    one->resize(rows);
  }
}

void MixedLikelihood::set_parameters(const Eigen::VectorXd& parameters) {
  fixed_part_ = model_.x * parameters.head(model_.num_fixed());
  loadings_.clear();
  const double* theta = parameters.data() + model_.num_fixed();
  Eigen::Index begin = 0;
  for (const MixedGrouping& grouping : model_.groupings) {
    loadings_.push_back(loadings_of(grouping, theta));
    theta += grouping.num_parameters();
    m_.middleCols(begin, grouping.z.cols()).noalias() = grouping.z * loadings_.back();
    begin += grouping.z.cols();
  }
}

double MixedLikelihood::mixed_part(std::size_t row, const Eigen::VectorXd& u) const {
  const double* m = m_.data() + row * static_cast<std::size_t>(head_size_ + tail_size_);
  const double* head = u.data() + first_group(row) * static_cast<std::size_t>(head_size_);
  double sum = 0.0;
  for (int i = 0; i < head_size_; ++i) sum += m[i] * head[i];
  const int* columns = columns_.data() + row * static_cast<std::size_t>(tail_size_);
  for (int i = 0; i < tail_size_; ++i) {
    sum += m[head_size_ + i] * u[information_.corner_begin() + columns[i]];
  }
  return sum;
}

void MixedLikelihood::add_transposed(std::size_t row, double weight,
                                     Eigen::VectorXd& to) const {
  const double* m = m_.data() + row * static_cast<std::size_t>(head_size_ + tail_size_);
  double* head = to.data() + first_group(row) * static_cast<std::size_t>(head_size_);
  for (int i = 0; i < head_size_; ++i) head[i] += weight * m[i];
  const int* columns = columns_.data() + row * static_cast<std::size_t>(tail_size_);
  for (int i = 0; i < tail_size_; ++i) {
    to[information_.corner_begin() + columns[i]] += weight * m[head_size_ + i];
  }
}

double MixedLikelihood::log_density(const Eigen::VectorXd& u) const {
  double sum = -0.5 * u.squaredNorm();
  for (std::size_t row = 0; row < model_.num_rows(); ++row) {
    const double yes = model_.num_yes[row], no = model_.num_trials[row] - yes;
    const MixedCurvePoint point = curve_point(
        model_.curve, fixed_part_[static_cast<Eigen::Index>(row)] + mixed_part(row, u));
    sum += (yes > 0.0 ? yes * point.log_yes : 0.0) + (no > 0.0 ? no * point.log_no : 0.0);
  }
  return sum;
}

void MixedLikelihood::evaluate_rows(const Eigen::VectorXd& u) {
  for (std::size_t row = 0; row < model_.num_rows(); ++row) {
    const auto at = static_cast<Eigen::Index>(row);
    const double yes = model_.num_yes[row], trials = model_.num_trials[row];
    const double no = trials - yes;
    const MixedCurvePoint p = curve_point(model_.curve, fixed_part_[at] + mixed_part(row, u));
    // The second derivatives use (P'/P)' = P'/P (P''/P' - P'/P) and (P'/(1-P))' = P'/(1-P)
    // (P''/P' + P'/(1-P)).
    rows_.score[at] = yes * p.rise_yes - no * p.rise_no;
    rows_.observed[at] =
        -yes * p.rise_yes * (p.bend - p.rise_yes) + no * p.rise_no * (p.bend + p.rise_no);
    rows_.expected[at] = trials * p.rise_yes * p.rise_no;
    rows_.drift[at] = rows_.expected[at] * (2.0 * p.bend - p.rise_yes + p.rise_no);
  }
}

bool MixedLikelihood::factorise(const Eigen::VectorXd& weights) {
  information_.set_identity();
  for (std::size_t row = 0; row < model_.num_rows(); ++row) {
    const double* m = m_.data() + row * static_cast<std::size_t>(head_size_ + tail_size_);
    const std::size_t tail = row * static_cast<std::size_t>(tail_size_);
    information_.add(weights[static_cast<Eigen::Index>(row)], first_group(row), m,
                     m + head_size_, columns_.data() + tail, places_.data() + tail, tail_size_);
  }
  return information_.factorise();
}

/// Newton's method on f. It uses the expected information where the observed one is not
/// positive definite, and halves a step that would lower f. It leaves the rows evaluated at the
/// modes, and returns f there.
std::optional<double> MixedLikelihood::find_modes() {
  constexpr int kMostSteps = 100;
  // After a gain below this, Newton's step leaves an error of about its square.
  constexpr double kEnough = 1e-9;
  double height = log_density(modes_);
  if (!std::isfinite(height)) {
    modes_.setZero();
    height = log_density(modes_);
  }
  if (!std::isfinite(height)) return std::nullopt;
  for (int step = 0; step < kMostSteps; ++step) {
    evaluate_rows(modes_);
    Eigen::VectorXd rise = -modes_;
    for (std::size_t row = 0; row < model_.num_rows(); ++row) {
      add_transposed(row, rows_.score[static_cast<Eigen::Index>(row)], rise);
    }
    if (!factorise(rows_.observed) && !factorise(rows_.expected)) return std::nullopt;
    Eigen::VectorXd move = rise;
    information_.solve(move);
    const double gain = move.dot(rise);
    if (!std::isfinite(gain)) return std::nullopt;
    if (gain < 1e-22) return height;
    double share = 1.0;
    while (share > 1e-10) {
      const Eigen::VectorXd moved = modes_ + share * move;
      const double there = log_density(moved);
      // Near the top, rounding hides changes of the height.
      if (there >= height - (gain < kEnough ? 1e-9 * (1.0 + std::fabs(height)) : 0.0)) {
        modes_ = moved;
        height = there;
        break;
      }
      share *= 0.5;
    }
    if (share <= 1e-10) break;
    if (gain < kEnough) break;
  }
  evaluate_rows(modes_);
  return height;
}

std::optional<double> MixedLikelihood::value(const Eigen::VectorXd& parameters) {
  set_parameters(parameters);
  const std::optional<double> height = find_modes();
  if (!height || !factorise(rows_.expected)) return std::nullopt;
  const double result = (num_nodes_ > 1 ? quadrature_sum() : *height) -
                        0.5 * information_.log_determinant() + model_.log_coefficients;
  if (!std::isfinite(result)) return std::nullopt;
  return result;
}

std::optional<double> MixedLikelihood::value(const Eigen::VectorXd& parameters,
                                             Eigen::VectorXd& gradient) {
  const std::optional<double> result = value(parameters);
  gradient = Eigen::VectorXd::Zero(num_parameters_);
  if (result && !add_gradient(gradient)) return std::nullopt;
  return result;
}

}  // namespace jnd::analysis
