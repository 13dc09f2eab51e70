#include "experiments/order/mixed_order.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "core/error.h"
#include "core/require.h"
#include "experiments/order/label_order.h"

namespace jnd::experiments {
namespace {

bool is_listed(const std::vector<std::string>& labels, const std::string& label) {
  return std::find(labels.begin(), labels.end(), label) != labels.end();
}

void require_constraints(const std::vector<std::string>& labels,
                         const OrderConstraints& constraints) {
  const int in_a_row = constraints.max_in_a_row.value_or(1);
  core::require(in_a_row >= 1, "order.max_in_a_row", "1 or more", in_a_row);
  core::require(constraints.min_distance >= 1, "order.min_distance", "1 or more",
                constraints.min_distance);
  for (const std::string& label : constraints.not_first) {
    if (is_listed(labels, label)) continue;
    throw core::Error("order.not_first: expected one of the labels, found `" + label + "`");
  }
  if (!labels.empty() && std::all_of(labels.begin(), labels.end(), [&](const auto& label) {
        return is_listed(constraints.not_first, label);
      })) {
    throw core::Error("order.not_first: expected a label that may be first, found none");
  }
}

/// Places of each label, by its name.
using Places = std::map<std::string, std::vector<std::size_t>>;

/// Throws `Error` for what follows from counting places. A label that occurs c times at
/// distance d takes (c - 1) d + 1 places. If several labels are the most frequent ones, each of
/// them needs another place after the last full distance. In rows of r a label needs the others
/// in between.
void require_room(const Places& places_of, std::size_t num_items,
                  const OrderConstraints& constraints) {
  std::size_t most = 0, num_most_frequent = 0;
  std::string most_frequent;
  for (const auto& [label, places] : places_of) {
    if (places.size() > most) {
      most = places.size();
      num_most_frequent = 0;
      most_frequent = label;
    }
    if (places.size() == most) ++num_most_frequent;
  }
  const auto distance = static_cast<std::size_t>(constraints.min_distance);
  const std::size_t needed = (most - 1) * distance + num_most_frequent;
  const std::string stands = "`" + most_frequent + "`, which stands " + std::to_string(most) +
                             " times" + (num_most_frequent > 1 ? " as others do" : "");
  if (distance > 1 && needed > num_items) {
    throw core::Error("order.min_distance: expected " + std::to_string(needed) +
                      " items or more for " + stands + ", at distance " +
                      std::to_string(distance) + ", found " + std::to_string(num_items) +
                      "; no order can meet this");
  }
  if (!constraints.max_in_a_row) return;
  const auto in_a_row = static_cast<std::size_t>(*constraints.max_in_a_row);
  const std::size_t num_others = num_items - most;
  const std::size_t others_needed = (most - 1) / in_a_row;
  if (num_others < others_needed) {
    throw core::Error("order.max_in_a_row: expected " + std::to_string(others_needed) +
                      " items or more between those of `" + most_frequent + "`, which stands " +
                      std::to_string(most) + " times, " + std::to_string(in_a_row) +
                      " in a row at most, found " + std::to_string(num_others) +
                      "; no order can meet this");
  }
}

LabelProblem problem_of(const Places& places_of, const OrderConstraints& constraints) {
  LabelProblem problem{.max_in_a_row = constraints.max_in_a_row,
                       .min_distance = constraints.min_distance};
  for (const auto& [label, places] : places_of) {
    problem.counts.push_back(static_cast<int>(places.size()));
    problem.may_be_first.push_back(!is_listed(constraints.not_first, label));
  }
  return problem;
}

/// Returns items in the order of their labels. Items of the same label are in random order.
std::vector<std::size_t> items_of(const std::vector<int>& label_order, const Places& places_of,
                                  core::RandomStream& stream) {
  std::vector<std::vector<std::size_t>> left;
  for (const auto& [label, places] : places_of) {
    left.push_back(places);
    stream.shuffle(left.back());
  }
  std::vector<std::size_t> order;
  for (const int label : label_order) {
    order.push_back(left[label].back());
    left[label].pop_back();
  }
  return order;
}

}  // namespace

bool meets(const std::vector<std::string>& labels, const OrderConstraints& constraints) {
  if (!labels.empty() && is_listed(constraints.not_first, labels.front())) return false;
  int num_in_a_row = 0;
  std::map<std::string, std::size_t> last_place;
  for (std::size_t place = 0; place < labels.size(); ++place) {
    num_in_a_row = place > 0 && labels[place] == labels[place - 1] ? num_in_a_row + 1 : 1;
    if (constraints.max_in_a_row && num_in_a_row > *constraints.max_in_a_row) return false;
    const auto [last, is_new] = last_place.try_emplace(labels[place], place);
    if (!is_new && place - last->second < static_cast<std::size_t>(constraints.min_distance)) {
      return false;
    }
    last->second = place;
  }
  return true;
}

ConstrainedOrder mixed_order(const std::vector<std::string>& labels,
                             const OrderConstraints& constraints, core::RandomStream& stream,
                             const ShuffleEffort& effort) {
  require_constraints(labels, constraints);
  if (labels.empty()) return {};
  Places places_of;
  for (std::size_t i = 0; i < labels.size(); ++i) places_of[labels[i]].push_back(i);
  require_room(places_of, labels.size(), constraints);

  std::vector<std::size_t> order(labels.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (int i = 0; i < effort.max_shuffles; ++i) {
    stream.shuffle(order);
    std::vector<std::string> shuffled;
    for (const std::size_t item : order) shuffled.push_back(labels[item]);
    if (meets(shuffled, constraints)) return {order, OrderMethod::kRejection};
  }
  using Outcome = LabelOrder::Outcome;
  const LabelProblem problem = problem_of(places_of, constraints);
  OrderMethod method = OrderMethod::kCounting;
  LabelOrder found = counted_order(problem, effort.max_states, stream);
  if (found.outcome == Outcome::kGaveUp) {
    method = OrderMethod::kSearch;
    found = searched_order(problem, effort.max_steps, stream);
  }
  if (found.outcome == Outcome::kFound)
    return {items_of(found.labels, places_of, stream), method};
  const std::string expected = "order: expected constraints that some order of the " +
                               std::to_string(labels.size()) + " items meets, found ";
  if (found.outcome == Outcome::kInfeasible) {
    throw core::Error(expected + "that none of all orders does; loosen them");
  }
  throw core::Error(expected + "none in " + std::to_string(effort.max_steps) +
                    " steps of search; loosen them");
}

}  // namespace jnd::experiments
