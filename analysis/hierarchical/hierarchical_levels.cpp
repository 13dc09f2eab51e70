#include "analysis/hierarchical/hierarchical_levels.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace jnd::analysis {
namespace {

std::string three_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

}  // namespace

LevelEase level_ease(const HierarchicalArrangement& all, const HierarchicalStructure& structure,
                     const Eigen::VectorXd& numbers, int condition) {
  constexpr double kVeryEasy = 2.5;
  const bool linear = structure.link == HierarchicalLink::kLinear;
  const double slope = linear ? numbers(condition) : std::exp(numbers(condition));
  const auto place_number = [&](double order) {
    const double place = structure.has_places ? numbers(structure.place_at(condition)) : 0.0;
    const double by_order =
        structure.has_orders() ? order * numbers(structure.order_at(condition)) : 0.0;
    return place + by_order;
  };
  const auto z_at = [&](double log_ratio, double order) {
    return linear ? slope * log_ratio + place_number(order)
                  : slope * (log_ratio - place_number(order));
  };
  double num_easy = 0.0, num_answers = 0.0;
  for (const HierarchicalPerson& person : all.people) {
    for (const HierarchicalCell& cell : person) {
      if (cell.condition != condition) continue;
      for (std::size_t level = 0; level < cell.log_ratio.size(); ++level) {
        const double num = cell.num_yes[level] + cell.num_no[level];
        num_answers += num;
        const double z = z_at(cell.log_ratio[level], cell.order[level]);
        if ((structure.guess_rate > 0.0 ? z : std::fabs(z)) >= 1.0) num_easy += num;
      }
    }
  }
  const double reference = all.reference[static_cast<std::size_t>(condition)];
  const double ln_pse = linear ? -place_number(0.0) / slope : place_number(0.0);
  const double reach = kVeryEasy / slope;
  return {.easy_ratio = num_answers > 0.0 ? num_easy / num_answers : 0.0,
          .easy_low = structure.guess_rate > 0.0 ? 0.0 : reference * std::exp(ln_pse - reach),
          .easy_high = reference * std::exp(ln_pse + reach)};
}

bool are_hard(const LevelEase& ease) noexcept {
  constexpr double kFew = 0.05;
  return ease.easy_ratio < kFew;
}

double largest_fraction(const HierarchicalArrangement& all, std::size_t condition) {
  double largest = 0.0;
  for (const AnswerCount& row : all.pooled[condition]) {
    if (row.num_trials > 0) largest = std::max(largest, row.intensity);
  }
  return largest / all.reference[condition] - 1.0;
}

std::string hard_levels(const LevelEase& ease, double weber_fraction,
                        std::optional<double> with_lapses) {
  const std::string share =
      ease.easy_ratio > 0.0
          ? "only " + three_digits(100.0 * ease.easy_ratio) + " % of the answers were"
          : std::string("no answer was");
  std::string effect;
  if (with_lapses) {
    effect = " (a lapse rate of 0.03 would make it " + three_digits(*with_lapses) +
             " instead of " + three_digits(weber_fraction) + ")";
  }
  return "the levels are too hard: " + share +
         " to a comparison as easy as the Weber fraction itself, which lies beyond them, and "
         "nothing tells lapses from a flat curve" +
         effect + "; levels " +
         (ease.easy_low > 0.0 ? "up to " + three_digits(ease.easy_low) + " or " : "") +
         "from " + three_digits(ease.easy_high) + " would";
}

}  // namespace jnd::analysis
