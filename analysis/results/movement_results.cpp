#include <algorithm>
#include <map>

#include "analysis/data/presentation_use.h"
#include "analysis/results/magnitude_section.h"
#include "analysis/results/study_results.h"
#include "analysis/words/said.h"
#include "experiments/study/media.h"

namespace jnd::analysis {
namespace {

struct Quantity {
  const char* name;
  const char* unit;
  const char* meaning;
  std::optional<double> core::PresentationMeasures::*value;
};

constexpr Quantity kQuantities[] = {
    {"stroke_width_m", "m", said_later("mean distance between turning points"),
     &core::PresentationMeasures::stroke_width_m},
    {"max_speed_m_per_s", "m/s", said_later("mean of the highest speed in each stroke"),
     &core::PresentationMeasures::max_speed_m_per_s},
    {"finger_lag_s", "s", said_later("by which thumb, index and middle trail behind the palm"),
     &core::PresentationMeasures::finger_lag_s},
};

using Rows = std::vector<core::PresentationRow>;
using ByParticipant = std::map<std::string, double>;

Rows all_presentations(const ParticipantData& participant) {
  Rows all;
  for (const auto& [block, rows] : participant.presentations) {
    all.insert(all.end(), rows.begin(), rows.end());
  }
  return all;
}

std::int64_t num_stimuli(const Rows& rows) {
  return std::ranges::count_if(
      rows, [](const core::PresentationRow& row) { return row.interval != "free_space"; });
}

/// Whether anybody has this measure. A device whose points move as one gives no finger lag, and
/// neither does a study whose database has layout 2.
bool anyone_has(const StudyData& data,
                std::optional<double> core::PresentationMeasures::*value) {
  if (value != &core::PresentationMeasures::finger_lag_s) return true;
  return std::ranges::any_of(data.participants, [value](const ParticipantData& participant) {
    return std::ranges::any_of(all_presentations(participant), [value](const auto& row) {
      return (row.measures.*value).has_value();
    });
  });
}

std::string why_missing(const Quantity& quantity, const Rows& rows) {
  const std::int64_t num_presented = num_stimuli(rows);
  const std::string name = std::string(quantity.name) + ": ";
  if (num_presented == 0) return said("{}no presentation of a stimulus", name);
  return said("{}none of {}{} holds a whole stroke", name, std::to_string(num_presented),
              (num_presented == 1 ? said(" presentation") : said(" presentations")));
}

/// Adds everybody's values over all blocks.
void add_whole(ResultsSection& section, const StudyData& data, const Quantity& quantity) {
  std::vector<double> whole;
  for (const ParticipantData& participant : data.participants) {
    const Rows rows = all_presentations(participant);
    if (const auto mean = movement_mean(rows, quantity.value)) {
      whole.push_back(*mean);
    } else {
      section.excluded.push_back({participant.participant, why_missing(quantity, rows)});
    }
  }
  add_mean(section, quantity.name, said(quantity.meaning), whole, quantity.unit);
}

/// The mean of a participant's mean over references and mean over tests. In a mean over all
/// presentations, the interval with more missing presentations would count less.
std::optional<double> equal_intervals_mean(const Rows& rows, const Quantity& quantity) {
  std::map<std::string, Rows> by_interval;
  for (const core::PresentationRow& row : rows) by_interval[row.interval].push_back(row);
  const auto reference = movement_mean(by_interval["reference"], quantity.value);
  const auto test = movement_mean(by_interval["test"], quantity.value);
  if (!reference || !test) return std::nullopt;
  return 0.5 * (*reference + *test);
}

bool has_both_intervals(const StudyData& data, const std::string& block) {
  bool reference = false;
  bool test = false;
  for (const ParticipantData& participant : data.participants) {
    const auto found = participant.presentations.find(block);
    if (found == participant.presentations.end()) continue;
    for (const core::PresentationRow& row : found->second) {
      reference = reference || row.interval == "reference";
      test = test || row.interval == "test";
    }
  }
  return reference && test;
}

/// How a participant's presentations of a block become one number.
struct Weighing {
  /// What is appended to names of estimates, to their meanings, and to comparisons.
  std::string suffix, meaning, words;
  std::optional<double> (*mean)(const Rows&, const Quantity&);
};

const Weighing kAsPublished = {"", "", "", [](const Rows& rows, const Quantity& quantity) {
                                 return movement_mean(rows, quantity.value);
                               }};
const Weighing kEqualIntervals = {
    ".equal_intervals", said_later(", references and tests weighed equally"),
    said_later(", references and tests weighed equally"), equal_intervals_mean};

ByParticipant means_of(const StudyData& data, const std::string& block,
                       const Quantity& quantity, const Weighing& weighing) {
  ByParticipant means;
  for (const ParticipantData& participant : data.participants) {
    const auto found = participant.presentations.find(block);
    if (found == participant.presentations.end()) continue;
    if (const auto mean = weighing.mean(found->second, quantity)) {
      means[participant.participant] = *mean;
    }
  }
  return means;
}

std::vector<double> numbers_of_people(const ByParticipant& means) {
  std::vector<double> values;
  for (const auto& [participant, mean] : means) values.push_back(mean);
  return values;
}

void compare(ResultsSection& section, const Quantity& quantity, const Weighing& weighing,
             const std::string& first, const ByParticipant& in_first, const std::string& second,
             const ByParticipant& in_second) {
  std::vector<double> a, b, differences;
  for (const auto& [participant, mean] : in_first) {
    const auto other = in_second.find(participant);
    if (other == in_second.end()) continue;
    a.push_back(mean);
    b.push_back(other->second);
    differences.push_back(mean - other->second);
  }
  if (differences.empty()) return;  // The blocks are in different arms, or nobody has both.
  add_mean(section,
           std::string(quantity.name) + "." + first + "_minus_" + second + weighing.suffix,
           said("{}, difference of the two blocks{}", std::string(said(quantity.meaning)),
                said_of(weighing.meaning)),
           differences, quantity.unit);
  const std::string name =
      first + " - " + second + ": " + quantity.name + said_of(weighing.words) + ", ";
  section.comparisons.push_back({name + said("paired"), paired_t_test(a, b)});
  if (weighing.suffix.empty()) {
    section.comparisons.push_back({name + "unpaired", welch_t_test(a, b)});
  }
}

/// Adds the estimates of every block, and the comparisons of each block with the next.
void add_blocks(ResultsSection& section, const StudyData& data, const Quantity& quantity,
                const Weighing& weighing, const std::vector<std::string>& blocks) {
  std::map<std::string, ByParticipant> by_block;
  for (const std::string& block : blocks) {
    by_block[block] = means_of(data, block, quantity, weighing);
    add_mean(section, std::string(quantity.name) + "." + block + weighing.suffix,
             said(quantity.meaning) + said_of(weighing.meaning),
             numbers_of_people(by_block[block]), quantity.unit);
  }
  for (std::size_t i = 0; i + 1 < blocks.size(); ++i) {
    compare(section, quantity, weighing, blocks[i], by_block[blocks[i]], blocks[i + 1],
            by_block[blocks[i + 1]]);
  }
}

}  // namespace

std::optional<double> movement_mean(const std::vector<core::PresentationRow>& presentations,
                                    std::optional<double> core::PresentationMeasures::*value) {
  double sum = 0.0;
  int count = 0;
  for (const core::PresentationRow& row : presentations) {
    if (row.interval == "free_space" || row.measures.num_strokes < 1 || !(row.measures.*value))
      continue;
    sum += *(row.measures.*value);
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

ResultsSection movement_results(const StudyData& data) {
  ResultsSection section{.name = "movement"};
  // Nothing is presented in which a stroke could be missing.
  if (data.blocks.empty()) return section;
  std::vector<std::string> blocks, with_both;
  for (const BlockDesign& block : data.blocks) {
    if (experiments::is_pressed(block.medium)) {
      section.excluded.push_back(
          {"everyone",
           said("{}: strokes, for a solid is pressed, not stroked through", block.block)});
      continue;
    }
    blocks.push_back(block.block);
    if (has_both_intervals(data, block.block)) with_both.push_back(block.block);
  }
  if (blocks.empty()) return section;
  for (const Quantity& quantity : kQuantities) {
    if (!anyone_has(data, quantity.value)) continue;
    add_whole(section, data, quantity);
    add_blocks(section, data, quantity, kAsPublished, blocks);
    if (!with_both.empty()) add_blocks(section, data, quantity, kEqualIntervals, with_both);
  }
  return section;
}

}  // namespace jnd::analysis
