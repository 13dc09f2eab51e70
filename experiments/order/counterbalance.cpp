#include "experiments/order/counterbalance.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "core/error.h"
#include "core/random_stream.h"

namespace jnd::experiments {
namespace {

using Arms = std::vector<std::string>;

/// Counts how many completed sessions had what a participant with these values might get.
class Filling {
 public:
  /// Counts for the whole cell, for its arms and orders each by itself, and for the cell
  /// whatever the participant's fields are. Earlier counts matter more.
  using Crowding = std::tuple<int, int, int>;

  Filling(const Study& study, const std::vector<std::string>& completed,
          const FieldValues& fields)
      : factors_(factors_of(study)), alone_(factors_.size()) {
    std::map<std::string, int> sessions;
    for (const std::string& text : completed) ++sessions[text];
    for (const Cell& cell : cells_of(study)) {
      const auto found = sessions.find(to_string(cell));
      if (found != sessions.end()) add(cell, found->second, field_values(study, cell), fields);
    }
  }

  [[nodiscard]] Crowding of(const Cell& cell) const {
    int alone = 0;
    for (std::size_t i = 0; i < cell.size(); ++i) alone += times(alone_[i], cell[i].arms);
    return {times(whole_, to_string(cell)), alone, times(assigned_, assigned(cell))};
  }

 private:
  template <typename Key>
  static int times(const std::map<Key, int>& counts, const Key& key) {
    const auto found = counts.find(key);
    return found == counts.end() ? 0 : found->second;
  }
  /// Returns the assigned part of a cell, without the participant's fields.
  [[nodiscard]] std::string assigned(const Cell& cell) const {
    Cell part;
    for (std::size_t i = 0; i < cell.size(); ++i) {
      if (!factors_[i].is_field) part.push_back(cell[i]);
    }
    return to_string(part);
  }
  void add(const Cell& cell, int num_sessions, const FieldValues& its,
           const FieldValues& fields) {
    whole_[to_string(cell)] += num_sessions;
    assigned_[assigned(cell)] += num_sessions;
    for (std::size_t i = 0; i < cell.size(); ++i) {
      const std::string& stratum = factors_[i].stratify_by;
      if (factors_[i].is_field || (!stratum.empty() && its.at(stratum) != fields.at(stratum))) {
        continue;
      }
      alone_[i][cell[i].arms] += num_sessions;
    }
  }

  std::vector<Factor> factors_;
  std::map<std::string, int> whole_, assigned_;
  std::vector<std::map<Arms, int>> alone_;  ///< One map for each factor.
};

/// Builds a participant's list of stages. As a class it spares the recursion four arguments.
class Flattening {
 public:
  explicit Flattening(const Cell& cell) : cell_(cell) {}

  void add(const std::vector<Stage>& stages, const std::string& path) {
    for (const Stage& stage : stages) {
      if (!is_for_this_cell(stage)) continue;
      const std::string here = path + stage.name;
      const auto* counterbalance = std::get_if<Counterbalance>(&stage.content);
      if (counterbalance == nullptr) {
        list.push_back({&stage, here, order_row(cell_, stage.name)});
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

FieldValues drawn_fields(const Study& study, std::uint64_t seed,
                         std::int64_t participant_index) {
  FieldValues values;
  std::int64_t index = 0;
  for (const ParticipantField& field : study.participant_fields) {
    core::RandomStream stream(seed, "participant field", {participant_index, index++});
    values[field.name] = field.options[stream.below(field.options.size())].value;
  }
  return values;
}

Cell least_filled_cell(const Study& study, const std::vector<std::string>& completed,
                       std::uint64_t seed, std::int64_t participant_index,
                       const FieldValues& fields) {
  if (const std::string problem = field_problem(study, fields); !problem.empty()) {
    throw core::Error("participant fields: " + problem);
  }
  const Filling filling(study, completed, fields);
  std::vector<Cell> best;
  Filling::Crowding least;
  for (Cell& cell : cells_of(study)) {
    if (field_values(study, cell) != fields) continue;
    const Filling::Crowding crowding = filling.of(cell);
    if (!best.empty() && crowding > least) continue;
    if (!best.empty() && crowding < least) best.clear();
    least = crowding;
    best.push_back(std::move(cell));
  }
  core::RandomStream stream(seed, "cell", {participant_index});
  return best[stream.below(best.size())];
}

std::vector<Cell> planned_cells(const Study& study, std::vector<std::string> completed,
                                std::uint64_t seed, std::int64_t first_participant_index,
                                int num_participants, const FieldValues& fields) {
  std::vector<Cell> cells;
  for (int i = 0; i < num_participants; ++i) {
    const std::int64_t index = first_participant_index + i;
    cells.push_back(
        least_filled_cell(study, completed, seed, index,
                          fields.empty() ? drawn_fields(study, seed, index) : fields));
    completed.push_back(to_string(cells.back()));
  }
  return cells;
}

Block block_of(const Stage& stage, std::size_t row, const Levels& people) {
  Block block = std::get<Block>(stage.content);
  block.order.row = row;
  block.levels.insert(people.begin(), people.end());
  block.levels[kBlockFactor] = stage.name;
  return block;
}

std::vector<StageInstance> stages_of(const Study& study, const Cell& cell) {
  require_cell(study, cell);
  Flattening flattening(cell);
  flattening.add(study.stages, "");
  const Levels people = people_levels(cell);
  for (StageInstance& instance : flattening.list) instance.people = people;
  return std::move(flattening.list);
}

}  // namespace jnd::experiments
