#include "analysis/statistics/group_sequential.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <utility>

#include "analysis/statistics/distributions.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

double density(double z) {
  constexpr double kInverseSqrt2Pi = 0.398942280401432677939946;
  return kInverseSqrt2Pi * std::exp(-0.5 * z * z);
}

double tail_above(double z) { return 0.5 * std::erfc(z / std::sqrt(2.0)); }

/// Beyond this many standard deviations a double cannot represent what is left.
constexpr double kReach = 8.0;

/// The place in [0, 38] where a falling function reaches the wanted value.
template <typename Falling>
double falls_to(double wanted, Falling falling) {
  double low = 0.0, high = 38.0;
  constexpr int kHalvings = 60;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (falling(middle) > wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

double spent_alpha(SpendingFunction spending, double alpha, double share) {
  core::require(alpha > 0.0 && alpha < 1.0, "alpha", "a number between 0 and 1", alpha);
  core::require(share > 0.0 && share <= 1.0, "share of the information",
                "a number above 0 and up to 1", share);
  if (spending == SpendingFunction::kPocock) return alpha * std::log1p(std::expm1(1.0) * share);
  const double z = normal_quantile_above(0.5 * alpha);
  return 2.0 * tail_above(z / std::sqrt(share));
}

SequentialPaths::SequentialPaths(std::vector<double> information, double drift)
    : information_(std::move(information)), drift_(drift), nodes_{{0.0, 1.0}} {
  double last = 0.0;
  for (const double one : information_) {
    core::require(one > last, "information at a look", "more than at the look before", one);
    last = one;
  }
}

double SequentialPaths::step() const {
  const double before = num_taken_ == 0 ? 0.0 : information_[num_taken_ - 1];
  return information_.at(num_taken_) - before;
}

double SequentialPaths::above(double z) const {
  const double step = this->step();
  const double score = z * std::sqrt(information_[num_taken_]);
  double share = 0.0;
  for (const Node& node : nodes_) {
    share += node.share * tail_above((score - node.score - drift_ * step) / std::sqrt(step));
  }
  return share;
}

double SequentialPaths::below(double z) const {
  const double step = this->step();
  const double score = z * std::sqrt(information_[num_taken_]);
  double share = 0.0;
  for (const Node& node : nodes_) {
    share += node.share * tail_above((node.score + drift_ * step - score) / std::sqrt(step));
  }
  return share;
}

void SequentialPaths::go_on(double lower, double upper) {
  using Rule = boost::math::quadrature::gauss<double, 20>;
  const double step = this->step(), width = std::sqrt(step);
  const double information = information_[num_taken_], root = std::sqrt(information);
  const double low = std::max(lower * root, drift_ * information - kReach * root);
  const double high = std::min(upper * root, drift_ * information + kReach * root);
  std::vector<Node> next;
  if (low < high) {
    // A panel is four times as wide as the narrower of the two steps that meet here. Its 20
    // points integrate bumps of that width to more digits than are ever reported.
    double narrow = width;
    if (num_taken_ + 1 < information_.size()) {
      narrow = std::min(narrow, std::sqrt(information_[num_taken_ + 1] - information));
    }
    const auto num_panels = static_cast<std::size_t>(std::ceil((high - low) / (4.0 * narrow)));
    const double half = 0.5 * (high - low) / static_cast<double>(num_panels);
    const auto add = [&](double score, double weight) {
      double sum = 0.0;
      for (const Node& node : nodes_) {
        sum += node.share * density((score - node.score - drift_ * step) / width);
      }
      next.push_back({score, weight * sum / width});
    };
    for (std::size_t panel = 0; panel < num_panels; ++panel) {
      const double middle = low + half * static_cast<double>(2 * panel + 1);
      for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
        const double reach = half * Rule::abscissa()[i], weight = half * Rule::weights()[i];
        add(middle - reach, weight);
        add(middle + reach, weight);
      }
    }
  }
  nodes_ = std::move(next);
  ++num_taken_;
}

std::vector<double> spending_boundaries(const std::vector<int>& looks,
                                        SpendingFunction spending, double alpha,
                                        bool two_sided) {
  core::require(!looks.empty(), "looks", "one or more", 0.0);
  constexpr double kNothing = 1e-15;
  const double side = two_sided ? 0.5 * alpha : alpha;
  const double sides = two_sided ? 2.0 : 1.0;
  SequentialPaths paths({looks.begin(), looks.end()}, 0.0);
  std::vector<double> boundaries;
  double spent = 0.0;
  for (const int look : looks) {
    const double until =
        sides * spent_alpha(spending, side, static_cast<double>(look) / looks.back());
    const double now = until - spent;
    double boundary = core::kInfinity;
    if (now > kNothing) {
      boundary = falls_to(now, [&](double z) { return sides * paths.above(z); });
      spent = until;
    }
    boundaries.push_back(boundary);
    if (look != looks.back()) paths.go_on(two_sided ? -boundary : -core::kInfinity, boundary);
  }
  return boundaries;
}

}  // namespace jnd::analysis
