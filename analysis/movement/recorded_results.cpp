#include "analysis/movement/recorded_results.h"

#include <functional>
#include <map>
#include <set>

#include "analysis/statistics/summary.h"

namespace jnd::analysis {
namespace {

using ByParticipant = std::map<std::string, double>;

struct Quantity {
  const char* name;
  const char* unit;
  const char* meaning;
  std::function<std::optional<double>(const ParticipantMovement&, const ConditionMovement&)>
      value;
};

/// The mean over the presentations of a block.
std::optional<double> delivered_ratio(const ParticipantMovement& person,
                                      const ConditionMovement& condition) {
  double sum = 0.0;
  int count = 0;
  for (const PresentationMovement& one : person.presentations) {
    if (one.block != condition.block || one.interval == "free_space") continue;
    if (!one.force.delivered_ratio) continue;
    sum += *one.force.delivered_ratio;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

/// The meaning of the ratio. It mentions sensors if the device of any person measured the
/// force.
const char* delivered_meaning(const MovementAnalysis& movement) {
  for (const ParticipantMovement& person : movement.participants) {
    for (const PresentationMovement& one : person.presentations) {
      if (one.force.is_measured) {
        return "delivered over commanded force; delivered is what sensors of force measured, "
               "where the device has them";
      }
    }
  }
  return "delivered over commanded force";
}

std::vector<Quantity> quantities(const MovementAnalysis& movement) {
  const auto stroke = [](std::optional<double> StrokeMeans::*value) {
    return [value](const ParticipantMovement&, const ConditionMovement& condition) {
      return condition.strokes.*value;
    };
  };
  return {
      {"mean_speed_m_per_s", "m/s", "mean speed over whole strokes",
       stroke(&StrokeMeans::mean_speed_m_per_s)},
      {"stroke_duration_s", "s", "duration of a stroke, pauses included",
       stroke(&StrokeMeans::stroke_duration_s)},
      {"pause_s", "s", "rest in a stroke", stroke(&StrokeMeans::pause_s)},
      {"stroke_energy_j", "J", "energy that the rendered force takes from the hand in a stroke",
       stroke(&StrokeMeans::stroke_energy_j)},
      {"hand_height_ratio", "1", "mean height of the hand above the floor, of the body height",
       [](const ParticipantMovement&, const ConditionMovement& condition) {
         return condition.hand_height_ratio;
       }},
      {"delivered_ratio", "1", delivered_meaning(movement), delivered_ratio},
      {"marked_ratio", "1",
       "share of presentations with missing ticks, lost contact, fault or limited force",
       [](const ParticipantMovement&, const ConditionMovement& condition) {
         return std::optional<double>(static_cast<double>(condition.num_marked) /
                                      condition.num_presentations);
       }},
  };
}

std::set<std::string> blocks_of(const MovementAnalysis& movement) {
  std::set<std::string> blocks;
  for (const ParticipantMovement& person : movement.participants) {
    for (const ConditionMovement& condition : person.conditions) {
      if (!condition.block.empty()) blocks.insert(condition.block);
    }
  }
  return blocks;
}

ByParticipant values_of(const MovementAnalysis& movement, const std::string& block,
                        const Quantity& quantity) {
  ByParticipant values;
  for (const ParticipantMovement& person : movement.participants) {
    const ConditionMovement* condition = person.find(block);
    if (condition == nullptr) continue;
    if (const auto value = quantity.value(person, *condition)) {
      values[person.participant] = *value;
    }
  }
  return values;
}

void add_estimate(ResultsSection& section, const Quantity& quantity, const std::string& block,
                  const ByParticipant& by_participant) {
  if (by_participant.empty()) return;
  std::vector<double> values;
  for (const auto& [participant, value] : by_participant) values.push_back(value);
  const Summary summary = summary_of(values);
  section.estimates.push_back({.name = std::string(quantity.name) + "." + block,
                               .value = summary.mean,
                               .ci95 = summary.mean_ci95,
                               .unit = quantity.unit,
                               .meaning = std::string("recordings: ") + quantity.meaning,
                               .n = summary.num_values});
}

void compare(ResultsSection& section, const Quantity& quantity, const std::string& first,
             const ByParticipant& in_first, const std::string& second,
             const ByParticipant& in_second) {
  std::vector<double> a, b;
  for (const auto& [participant, value] : in_first) {
    const auto other = in_second.find(participant);
    if (other == in_second.end()) continue;
    a.push_back(value);
    b.push_back(other->second);
  }
  if (a.empty()) return;
  section.comparisons.push_back(
      {first + " - " + second + ": " + quantity.name + ", paired", paired_t_test(a, b)});
}

void add_body_height(ResultsSection& section, const MovementAnalysis& movement,
                     const std::string& block) {
  std::vector<double> height_m, width_m, speed_m_per_s;
  for (const ParticipantMovement& person : movement.participants) {
    const ConditionMovement* condition = person.find(block);
    if (condition == nullptr || !person.body_height_m) continue;
    if (!condition->strokes.stroke_width_m || !condition->strokes.max_speed_m_per_s) continue;
    height_m.push_back(*person.body_height_m);
    width_m.push_back(*condition->strokes.stroke_width_m);
    speed_m_per_s.push_back(*condition->strokes.max_speed_m_per_s);
  }
  if (height_m.empty()) return;
  section.comparisons.push_back({block + ": stroke_width_m with body_height_m, Pearson",
                                 pearson_correlation(width_m, height_m)});
  section.comparisons.push_back({block + ": max_speed_m_per_s with body_height_m, Pearson",
                                 pearson_correlation(speed_m_per_s, height_m)});
}

}  // namespace

ResultsSection recorded_results(const MovementAnalysis& movement) {
  ResultsSection section{.name = "recorded_movement"};
  for (const ParticipantMovement& person : movement.participants) {
    if (!person.reason.empty()) section.excluded.push_back({person.participant, person.reason});
  }
  const std::set<std::string> blocks = blocks_of(movement);
  for (const Quantity& quantity : quantities(movement)) {
    std::map<std::string, ByParticipant> by_block;
    for (const std::string& block : blocks) {
      by_block[block] = values_of(movement, block, quantity);
      add_estimate(section, quantity, block, by_block[block]);
    }
    for (auto first = by_block.begin(); first != by_block.end(); ++first) {
      const auto second = std::next(first);
      if (second == by_block.end()) break;
      compare(section, quantity, first->first, first->second, second->first, second->second);
    }
  }
  for (const std::string& block : blocks) add_body_height(section, movement, block);
  return section;
}

}  // namespace jnd::analysis
