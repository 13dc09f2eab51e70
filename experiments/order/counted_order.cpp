#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <unordered_map>
#include <utility>

#include "experiments/order/label_order.h"

namespace jnd::experiments {
namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();
/// Each place is a level of recursion. No session has as many trials.
constexpr int kMaxItems = 2000;

/// The state of an order, without the names of the labels.
struct State {
  // For each label that may come next, how many of its items are left; ascending, without 0.
  std::u16string free;
  // For each of the labels used last, how many of its items are left; the latest label first.
  std::u16string recent;
  int num_in_a_row = 0;  // How often the last label came in a row, if that is limited.

  [[nodiscard]] std::u16string key() const {
    std::u16string text = free;
    text += u'\xffff';
    text += recent;
    text += static_cast<char16_t>(num_in_a_row);
    return text;
  }
};

void insert_sorted(std::u16string& counts, char16_t count) {
  if (count > 0) counts.insert(std::upper_bound(counts.begin(), counts.end(), count), count);
}

class Counting {
 public:
  Counting(const LabelProblem& problem, int max_states)
      : max_states_(static_cast<std::size_t>(max_states)) {
    if (problem.min_distance > 1) {
      num_recent_ = static_cast<std::size_t>(problem.min_distance) - 1;
    } else if (problem.max_in_a_row) {
      num_recent_ = 1;
      max_in_a_row_ = *problem.max_in_a_row;
    }
  }

  [[nodiscard]] bool gave_up() const noexcept { return known_.size() > max_states_; }

  /// Returns the state after an item of a free label, of which `count` are left, was used.
  [[nodiscard]] State after_free(const State& state, char16_t count) const {
    State next = state;
    next.free.erase(next.free.find(count), 1);
    next.recent.insert(next.recent.begin(), static_cast<char16_t>(count - 1));
    next.num_in_a_row = max_in_a_row_ > 0 ? 1 : 0;
    if (next.recent.size() > num_recent_) {
      insert_sorted(next.free, next.recent.back());
      next.recent.pop_back();
    }
    return next;
  }
  [[nodiscard]] bool may_repeat(const State& state) const noexcept {
    return state.num_in_a_row > 0 && state.num_in_a_row < max_in_a_row_ &&
           state.recent.front() > 0;
  }
  [[nodiscard]] static State after_repeat(const State& state) {
    State next = state;
    --next.recent.front();
    ++next.num_in_a_row;
    return next;
  }

  /// Returns ln of the share of all orders of the remaining items that meet the constraints.
  /// The share itself can be smaller than the smallest number.
  [[nodiscard]] double ln_share(const State& state) {
    const auto num_left = [](const std::u16string& counts) {
      return std::accumulate(counts.begin(), counts.end(), 0);
    };
    const int num_items = num_left(state.free) + num_left(state.recent);
    if (num_items == 0) return 0.0;
    std::u16string key = state.key();
    if (const auto known = known_.find(key); known != known_.end()) return known->second;
    if (gave_up()) return kNever;
    std::vector<double> shares;
    for (std::size_t i = 0; i < state.free.size();) {
      const char16_t count = state.free[i];
      const std::size_t next = state.free.find_first_not_of(count, i);
      const std::size_t num_labels = std::min(next, state.free.size()) - i;
      shares.push_back(std::log(static_cast<double>(num_labels * count)) +
                       ln_share(after_free(state, count)));
      i += num_labels;
    }
    if (may_repeat(state)) {
      shares.push_back(std::log(static_cast<double>(state.recent.front())) +
                       ln_share(after_repeat(state)));
    }
    double largest = kNever, sum = 0.0;
    for (const double share : shares) largest = std::max(largest, share);
    if (largest == kNever) return known_[std::move(key)] = kNever;
    for (const double share : shares) sum += std::exp(share - largest);
    return known_[std::move(key)] = largest + std::log(sum) - std::log(num_items);
  }

  [[nodiscard]] std::size_t num_recent() const noexcept { return num_recent_; }

 private:
  std::size_t max_states_;
  std::size_t num_recent_ = 0;
  int max_in_a_row_ = 0;  // 0 means no limit.
  std::unordered_map<std::u16string, double> known_;
};

/// A label that may come next.
struct Choice {
  int label = 0;
  double ln_weight = 0.0;
  State next;
};

std::size_t drawn(const std::vector<Choice>& choices, core::RandomStream& stream) {
  double largest = kNever, sum = 0.0;
  for (const Choice& choice : choices) largest = std::max(largest, choice.ln_weight);
  for (const Choice& choice : choices) sum += std::exp(choice.ln_weight - largest);
  double rest = stream.uniform(0.0, sum);
  std::size_t last_possible = 0;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (choices[i].ln_weight == kNever) continue;
    last_possible = i;
    rest -= std::exp(choices[i].ln_weight - largest);
    if (rest < 0.0) break;
  }
  return last_possible;
}

}  // namespace

int LabelProblem::num_items() const noexcept {
  return std::accumulate(counts.begin(), counts.end(), 0);
}

LabelOrder counted_order(const LabelProblem& problem, int max_states,
                         core::RandomStream& stream) {
  using Outcome = LabelOrder::Outcome;
  if (problem.num_items() > kMaxItems) return {};
  Counting counting(problem, max_states);
  std::vector<int> left = problem.counts;
  std::vector<int> recent;  // Labels used last, the latest first.
  State state;
  for (const int count : left) insert_sorted(state.free, static_cast<char16_t>(count));
  LabelOrder order{.outcome = Outcome::kFound};
  for (int place = 0; place < problem.num_items(); ++place) {
    std::vector<Choice> choices;
    for (int label = 0; label < static_cast<int>(left.size()); ++label) {
      if (left[label] == 0 || (place == 0 && !problem.may_be_first[label])) continue;
      const bool is_recent = std::find(recent.begin(), recent.end(), label) != recent.end();
      if (is_recent && !counting.may_repeat(state)) continue;
      State next = is_recent ? Counting::after_repeat(state)
                             : counting.after_free(state, static_cast<char16_t>(left[label]));
      const double ln_share = counting.ln_share(next);
      choices.push_back({label, std::log(left[label]) + ln_share, std::move(next)});
    }
    if (counting.gave_up()) return {};
    if (std::all_of(choices.begin(), choices.end(),
                    [](const Choice& choice) { return choice.ln_weight == kNever; })) {
      return {.outcome = Outcome::kInfeasible};
    }
    const Choice& choice = choices[drawn(choices, stream)];
    order.labels.push_back(choice.label);
    --left[choice.label];
    if (std::find(recent.begin(), recent.end(), choice.label) == recent.end()) {
      recent.insert(recent.begin(), choice.label);
      if (recent.size() > counting.num_recent()) recent.pop_back();
    }
    state = choice.next;
  }
  return order;
}

}  // namespace jnd::experiments
