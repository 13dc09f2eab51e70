#include <algorithm>
#include <cmath>
#include <utility>

#include "experiments/order/label_order.h"

namespace jnd::experiments {
namespace {

constexpr int kNumStarts = 20;

/// An order as far as it has been built.
class Building {
 public:
  explicit Building(const LabelProblem& problem)
      : problem_(problem),
        num_items_(problem.num_items()),
        left_(problem.counts),
        places_(left_.size()) {}

  [[nodiscard]] const std::vector<int>& labels() const noexcept { return labels_; }
  [[nodiscard]] bool is_whole() const noexcept { return num_placed() == num_items_; }

  void put(int label) {
    --left_[label];
    places_[label].push_back(num_placed());
    labels_.push_back(label);
  }
  void take_back() {
    const int label = labels_.back();
    labels_.pop_back();
    places_[label].pop_back();
    ++left_[label];
  }

  /// Returns the labels that may come next. Those with many remaining items tend to come last.
  [[nodiscard]] std::vector<int> drawn_candidates(core::RandomStream& stream) const {
    // Of exponential waiting times, each label's is the shortest with a probability in
    // proportion to its rate.
    std::vector<std::pair<double, int>> waiting;
    for (int label = 0; label < static_cast<int>(left_.size()); ++label) {
      if (left_[label] == 0 || !may_come(label)) continue;
      waiting.emplace_back(-std::log(1.0 - stream.uniform()) / left_[label], label);
    }
    std::sort(waiting.rbegin(), waiting.rend());
    std::vector<int> candidates;
    for (const auto& [time, label] : waiting) candidates.push_back(label);
    return candidates;
  }

  /// Whether each label by itself has room for its items. Without that the order cannot be
  /// completed.
  [[nodiscard]] bool has_room() const noexcept {
    const int num_left = num_items_ - num_placed();
    for (int label = 0; label < static_cast<int>(left_.size()); ++label) {
      if (left_[label] == 0) continue;
      const int earliest =
          places_[label].empty()
              ? num_placed()
              : std::max(num_placed(), places_[label].back() + problem_.min_distance);
      if (earliest + (left_[label] - 1) * problem_.min_distance >= num_items_) return false;
      if (!problem_.max_in_a_row) continue;
      const int most = *problem_.max_in_a_row;
      if (left_[label] > most * (num_left - left_[label] + 1) - num_in_a_row(label)) {
        return false;
      }
    }
    return true;
  }

 private:
  [[nodiscard]] int num_placed() const noexcept { return static_cast<int>(labels_.size()); }
  [[nodiscard]] int num_in_a_row(int label) const noexcept {
    const auto end = std::find_if(labels_.rbegin(), labels_.rend(),
                                  [&](int other) { return other != label; });
    return static_cast<int>(end - labels_.rbegin());
  }
  [[nodiscard]] bool may_come(int label) const noexcept {
    if (labels_.empty()) return problem_.may_be_first[label];
    if (problem_.max_in_a_row && num_in_a_row(label) >= *problem_.max_in_a_row) return false;
    return places_[label].empty() ||
           num_placed() - places_[label].back() >= problem_.min_distance;
  }

  const LabelProblem& problem_;
  int num_items_;
  std::vector<int> left_;
  std::vector<int> labels_;
  std::vector<std::vector<int>> places_;  // For each label, ascending.
};

}  // namespace

LabelOrder searched_order(const LabelProblem& problem, int max_steps,
                          core::RandomStream& stream) {
  using Outcome = LabelOrder::Outcome;
  for (int start = 0; start < kNumStarts; ++start) {
    Building building(problem);
    // The labels that are still to be tried, for each place so far.
    std::vector<std::vector<int>> untried = {building.drawn_candidates(stream)};
    for (int step = 0; step < max_steps / kNumStarts; ++step) {
      if (building.is_whole()) return {Outcome::kFound, building.labels()};
      if (untried.back().empty()) {
        untried.pop_back();
        if (untried.empty()) return {Outcome::kInfeasible, {}};
        building.take_back();
        continue;
      }
      building.put(untried.back().back());
      untried.back().pop_back();
      if (building.has_room()) {
        untried.push_back(building.drawn_candidates(stream));
      } else {
        building.take_back();
      }
    }
  }
  return {};
}

}  // namespace jnd::experiments
