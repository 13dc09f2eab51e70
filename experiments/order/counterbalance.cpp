#include "experiments/order/counterbalance.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "core/error.h"
#include "core/random_stream.h"

namespace jnd::experiments {
namespace {

using Arms = std::vector<std::string>;

/// Rows of a Williams square over 0 .. n-1: n of them for an even n, 2n for an odd one.
std::vector<std::vector<std::size_t>> williams_rows(std::size_t n) {
  // The first row runs 0, 1, n-1, 2, n-2 ...; each further row adds one to every place.
  std::vector<std::size_t> first = {0};
  for (std::size_t low = 1, high = n - 1; first.size() < n; ++low, --high) {
    first.push_back(low);
    if (first.size() < n) first.push_back(high);
  }
  std::vector<std::vector<std::size_t>> rows;
  for (std::size_t shift = 0; shift < n; ++shift) {
    std::vector<std::size_t> row;
    for (const std::size_t place : first) row.push_back((place + shift) % n);
    rows.push_back(row);
  }
  if (n % 2 == 1) {
    for (std::size_t i = 0; i < n; ++i) {
      rows.emplace_back(rows[i].rbegin(), rows[i].rend());
    }
  }
  return rows;
}

std::vector<std::vector<std::size_t>> all_orders(std::size_t n) {
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<std::vector<std::size_t>> orders;
  do {
    orders.push_back(order);
  } while (std::next_permutation(order.begin(), order.end()));
  return orders;
}

/// What a counterbalance can give, each as a list of arms.
std::vector<Arms> alternatives(const Counterbalance& counterbalance) {
  std::vector<Arms> found;
  if (counterbalance.method == Counterbalance::Method::kOneOf) {
    for (const Counterbalance::Arm& arm : counterbalance.arms) found.push_back({arm.name});
    return found;
  }
  const std::size_t num_arms = counterbalance.arms.size();
  for (const auto& order : num_arms <= 3 ? all_orders(num_arms) : williams_rows(num_arms)) {
    Arms arms;
    for (const std::size_t index : order) arms.push_back(counterbalance.arms[index].name);
    found.push_back(std::move(arms));
  }
  return found;
}

const Assignment* find_assignment(const Cell& cell, const std::string& counterbalance) {
  for (const Assignment& assignment : cell) {
    if (assignment.counterbalance == counterbalance) return &assignment;
  }
  return nullptr;
}

/// Builds a participant's list, so that the recursion does not carry four arguments along.
class Flattening {
 public:
  explicit Flattening(const Cell& cell) : cell_(cell) {}

  void add(const std::vector<Stage>& stages, const std::string& path) {
    for (const Stage& stage : stages) {
      if (!is_for_this_cell(stage)) continue;
      const std::string here = path + stage.name;
      const auto* counterbalance = std::get_if<Counterbalance>(&stage.content);
      if (counterbalance == nullptr) {
        list.push_back({&stage, here});
      } else {
        add_arms(*counterbalance, find_assignment(cell_, stage.name)->arms, here);
      }
    }
  }

  std::vector<StageInstance> list;

 private:
  void add_arms(const Counterbalance& counterbalance, const Arms& arms,
                const std::string& path) {
    for (std::size_t i = 0; i < arms.size(); ++i) {
      if (i > 0) {
        add(counterbalance.between, path + "/between_" + std::to_string(i) + '/');
      }
      for (const Counterbalance::Arm& arm : counterbalance.arms) {
        if (arm.name == arms[i]) add(arm.stages, path + '/' + arm.name + '/');
      }
    }
  }
  [[nodiscard]] bool is_for_this_cell(const Stage& stage) const {
    return std::all_of(stage.only_for.begin(), stage.only_for.end(), [&](const auto& wanted) {
      const Assignment* given = find_assignment(cell_, wanted.first);
      return given != nullptr && given->arms == Arms{wanted.second};
    });
  }

  const Cell& cell_;
};

}  // namespace

std::string to_string(const Cell& cell) {
  std::string text;
  for (const Assignment& assignment : cell) {
    if (!text.empty()) text += ';';
    text += assignment.counterbalance + '=';
    for (std::size_t i = 0; i < assignment.arms.size(); ++i) {
      text += (i > 0 ? "," : "") + assignment.arms[i];
    }
  }
  return text;
}

std::vector<Cell> cells_of(const Study& study) {
  std::vector<Cell> cells = {{}};
  for (const Stage& stage : study.stages) {
    const auto* counterbalance = std::get_if<Counterbalance>(&stage.content);
    if (counterbalance == nullptr) continue;
    std::vector<Cell> crossed;
    for (const Cell& cell : cells) {
      for (const Arms& arms : alternatives(*counterbalance)) {
        crossed.push_back(cell);
        crossed.back().push_back({stage.name, arms});
      }
    }
    cells = std::move(crossed);
  }
  return cells;
}

Cell cell_from_text(const Study& study, const std::string& text) {
  for (Cell& cell : cells_of(study)) {
    if (to_string(cell) == text) return std::move(cell);
  }
  throw core::Error("cell: expected one of the study `" + study.name + "`, found `" + text +
                    "`");
}

Cell least_filled_cell(const Study& study, const std::vector<std::string>& completed,
                       std::uint64_t seed, std::int64_t participant_index) {
  std::vector<Cell> cells = cells_of(study);
  std::map<std::string, int> filled;  // Both whole cells and single assignments, by text.
  for (const Cell& cell : cells) {
    const auto times =
        static_cast<int>(std::count(completed.begin(), completed.end(), to_string(cell)));
    filled[to_string(cell)] = times;
    if (cell.size() < 2) continue;
    for (const Assignment& assignment : cell) filled[to_string(Cell{assignment})] += times;
  }
  const auto crowding = [&](const Cell& cell) {
    int of_each_alone = 0;
    for (const Assignment& assignment : cell) of_each_alone += filled[to_string({assignment})];
    return std::pair(filled[to_string(cell)], of_each_alone);
  };
  std::vector<Cell> best;
  for (Cell& cell : cells) {
    if (!best.empty() && crowding(cell) > crowding(best.front())) continue;
    if (!best.empty() && crowding(cell) < crowding(best.front())) best.clear();
    best.push_back(std::move(cell));
  }
  core::RandomStream stream(seed, "cell", {participant_index});
  return best[stream.below(best.size())];
}

std::vector<Cell> planned_cells(const Study& study, std::vector<std::string> completed,
                                std::uint64_t seed, std::int64_t first_participant_index,
                                int num_participants) {
  std::vector<Cell> cells;
  for (int i = 0; i < num_participants; ++i) {
    cells.push_back(least_filled_cell(study, completed, seed, first_participant_index + i));
    completed.push_back(to_string(cells.back()));
  }
  return cells;
}

std::vector<StageInstance> stages_of(const Study& study, const Cell& cell) {
  static_cast<void>(cell_from_text(study, to_string(cell)));
  Flattening flattening(cell);
  flattening.add(study.stages, "");
  return std::move(flattening.list);
}

}  // namespace jnd::experiments
