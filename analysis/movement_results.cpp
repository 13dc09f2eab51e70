#include <algorithm>
#include <map>

#include "analysis/groups/summary.h"
#include "analysis/study_results.h"

namespace jnd::analysis {
namespace {

void add(ResultsSection& section, const std::string& name, const std::string& unit,
         const std::string& meaning, const std::vector<double>& values) {
  const Summary summary = summary_of(values);
  section.estimates.push_back({.name = name,
                               .value = summary.mean,
                               .ci95 = summary.mean_ci95,
                               .unit = unit,
                               .meaning = meaning,
                               .n = summary.num_values});
}

std::vector<core::PresentationRow> all_presentations(const ParticipantData& participant) {
  std::vector<core::PresentationRow> all;
  for (const auto& [block, rows] : participant.presentations) {
    all.insert(all.end(), rows.begin(), rows.end());
  }
  return all;
}

/// A device whose points move as one gives no lag, one of layout 2 neither.
bool anyone_has(const StudyData& data, std::optional<double> core::PresentationRow::*value) {
  if (value != &core::PresentationRow::finger_lag_s) return true;
  return std::ranges::any_of(data.participants, [value](const ParticipantData& participant) {
    return std::ranges::any_of(all_presentations(participant),
                               [value](const auto& row) { return (row.*value).has_value(); });
  });
}

}  // namespace

std::optional<double> movement_mean(const std::vector<core::PresentationRow>& presentations,
                                    std::optional<double> core::PresentationRow::*value) {
  double sum = 0.0;
  int count = 0;
  for (const core::PresentationRow& row : presentations) {
    if (row.interval == "free_space" || row.num_strokes < 1 || !(row.*value)) continue;
    sum += *(row.*value);
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

ResultsSection movement_results(const StudyData& data) {
  ResultsSection section{.name = "movement"};
  const struct {
    const char* name;
    const char* unit;
    const char* meaning;
    std::optional<double> core::PresentationRow::*value;
  } kQuantities[] = {
      {"stroke_width_m", "m", "mean distance between turning points",
       &core::PresentationRow::stroke_width_m},
      {"max_speed_m_per_s", "m/s", "mean of the highest speed in each stroke",
       &core::PresentationRow::max_speed_m_per_s},
      {"finger_lag_s", "s", "by which thumb, index and middle trail behind the palm",
       &core::PresentationRow::finger_lag_s},
  };
  for (const auto& quantity : kQuantities) {
    if (!anyone_has(data, quantity.value)) continue;
    std::vector<double> whole;
    for (const ParticipantData& participant : data.participants) {
      if (const auto mean = movement_mean(all_presentations(participant), quantity.value)) {
        whole.push_back(*mean);
      } else {
        section.excluded.push_back(
            {participant.participant, std::string("no whole stroke: ") + quantity.name});
      }
    }
    add(section, quantity.name, quantity.unit, quantity.meaning, whole);
    std::map<std::string, std::map<std::string, double>> by_block;
    for (const BlockDesign& block : data.blocks) {
      for (const ParticipantData& participant : data.participants) {
        const auto found = participant.presentations.find(block.block);
        if (found == participant.presentations.end()) continue;
        if (const auto mean = movement_mean(found->second, quantity.value)) {
          by_block[block.block][participant.participant] = *mean;
        }
      }
      std::vector<double> values;
      for (const auto& [participant, mean] : by_block[block.block]) values.push_back(mean);
      add(section, std::string(quantity.name) + "." + block.block, quantity.unit,
          quantity.meaning, values);
    }
    for (std::size_t i = 0; i + 1 < data.blocks.size(); ++i) {
      const std::string& first = data.blocks[i].block;
      const std::string& second = data.blocks[i + 1].block;
      std::vector<double> a;
      std::vector<double> b;
      for (const auto& [participant, mean] : by_block[first]) {
        const auto other = by_block[second].find(participant);
        if (other == by_block[second].end()) continue;
        a.push_back(mean);
        b.push_back(other->second);
      }
      std::vector<double> differences;
      for (std::size_t j = 0; j < a.size(); ++j) differences.push_back(a[j] - b[j]);
      add(section, std::string(quantity.name) + "." + first + "_minus_" + second, quantity.unit,
          std::string(quantity.meaning) + ", difference of the two blocks", differences);
      section.comparisons.push_back(
          {first + " - " + second + ": " + quantity.name + ", paired", paired_t_test(a, b)});
      section.comparisons.push_back(
          {first + " - " + second + ": " + quantity.name + ", unpaired", welch_t_test(a, b)});
    }
  }
  return section;
}

}  // namespace jnd::analysis
