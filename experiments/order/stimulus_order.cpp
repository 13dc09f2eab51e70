#include "experiments/order/stimulus_order.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "core/require.h"
#include "experiments/order/mixed_order.h"
#include "experiments/order/square_rows.h"

namespace jnd::experiments {
namespace {

using Order = std::vector<std::size_t>;
using Method = StimulusOrder::Method;

OrderRows rows_of(const StimulusOrder& order, std::size_t num_stimuli) {
  if (order.method == Method::kLatin) return latin_rows(num_stimuli);
  if (order.method == Method::kWilliams) return williams_rows(num_stimuli);
  return {};
}

bool may_be_first(const StimulusOrder& order, double stimulus) {
  return std::find(order.not_first.begin(), order.not_first.end(), stimulus) ==
         order.not_first.end();
}

/// Draws an order in which no stimulus comes sooner than `distance` trials after its place in
/// the order before. All such orders are equally likely.
Order spaced_after(const Order& before, std::size_t distance, core::RandomStream& stream) {
  const std::size_t n = before.size();
  Order order(n, n);  // n marks a free place.
  // The stimulus that came last has the fewest places to choose from, and all of them are open
  // to the others as well. So the number of ways to continue does not depend on its choice.
  for (std::size_t place = n; place-- > 0;) {
    Order free;
    for (std::size_t next = std::max(place + distance, n) - n; next < n; ++next) {
      if (order[next] == n) free.push_back(next);
    }
    order[free[stream.below(free.size())]] = before[place];
  }
  return order;
}

Order shuffled(const StimulusOrder& rule, const std::vector<double>& stimuli,
               int num_repetitions, core::RandomStream& stream) {
  const auto n = static_cast<int>(stimuli.size());
  const int in_a_row = rule.max_in_a_row.value_or(num_repetitions);
  const int distance = std::max(rule.min_distance, in_a_row == 1 ? 2 : 1);
  core::require(num_repetitions == 1 || distance <= n, "order.min_distance",
                "as many stimuli or more", distance);
  core::require(n > 1 || num_repetitions <= in_a_row, "order.max_in_a_row",
                "at least the repetitions of the only stimulus", in_a_row);
  Order all;
  Order one(stimuli.size());
  for (int repetition = 0; repetition < num_repetitions; ++repetition) {
    if (repetition > 0 && distance > 1) {
      one = spaced_after(one, static_cast<std::size_t>(distance), stream);
    } else {
      std::iota(one.begin(), one.end(), std::size_t{0});
      do {
        stream.shuffle(one);
      } while (repetition == 0 && !may_be_first(rule, stimuli[one.front()]));
    }
    all.insert(all.end(), one.begin(), one.end());
  }
  return all;
}

Order mixed(const StimulusOrder& rule, const std::vector<double>& stimuli, int num_repetitions,
            core::RandomStream& stream) {
  std::vector<std::string> labels;
  OrderConstraints constraints = {.max_in_a_row = rule.max_in_a_row, .not_first = {}};
  for (std::size_t i = 0; i < stimuli.size() * static_cast<std::size_t>(num_repetitions); ++i) {
    labels.push_back(std::to_string(i % stimuli.size()));
  }
  for (std::size_t i = 0; i < stimuli.size(); ++i) {
    if (!may_be_first(rule, stimuli[i])) constraints.not_first.push_back(std::to_string(i));
  }
  Order order = mixed_order(labels, constraints, stream).order;
  for (std::size_t& item : order) item %= stimuli.size();
  return order;
}

}  // namespace

std::size_t num_square_rows(const StimulusOrder& order, std::size_t num_stimuli) {
  return rows_of(order, num_stimuli).size();
}

std::vector<std::size_t> stimulus_order(const StimulusOrder& order,
                                        const std::vector<double>& stimuli, int num_repetitions,
                                        core::RandomStream& stream) {
  core::require(std::any_of(stimuli.begin(), stimuli.end(),
                            [&](double stimulus) { return may_be_first(order, stimulus); }),
                "order.not_first", "a stimulus left that may be first",
                static_cast<int>(order.not_first.size()));
  if (order.method == Method::kMixed) return mixed(order, stimuli, num_repetitions, stream);
  const OrderRows rows = rows_of(order, stimuli.size());
  if (rows.empty()) return shuffled(order, stimuli, num_repetitions, stream);
  Order all;
  for (std::size_t i = 0; i < static_cast<std::size_t>(num_repetitions); ++i) {
    const Order& row = rows[(order.row + i) % rows.size()];
    all.insert(all.end(), row.begin(), row.end());
  }
  return all;
}

}  // namespace jnd::experiments
