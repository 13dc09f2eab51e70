#include "analysis/results/person_outcome.h"

#include "analysis/data/magnitude_means.h"
#include "analysis/results/discrimination_answers.h"
#include "analysis/results/study_results.h"
#include "analysis/results/trial_correlations.h"

namespace jnd::analysis {
namespace {

using ByName = std::map<std::string, PersonOutcome*>;

void add_counts(const StudyData& data, const BlockDesign& block, const ByName& people) {
  std::vector<ExcludedParticipant> without;
  for (const DiscriminationAnswers& answers :
       discrimination_answers(data, block, false, without)) {
    PersonOutcome& person = *people.at(answers.participant);
    person.counts[block.block] = answers.levels;
    person.numbers[block.block + ".reference"] = answers.reference;
  }
}

void add_means(const MagnitudeBlock& magnitudes, const std::string& block,
               const ByName& people) {
  for (std::size_t i = 0; i < magnitudes.size(); ++i) {
    people.at(magnitudes.names[i])->means[block] = magnitudes.means[i];
  }
}

void add_movement(const ParticipantData& participant, PersonOutcome& person) {
  constexpr std::pair<const char*, std::optional<double> core::PresentationMeasures::*>
      kMovements[] = {{"stroke_width_m", &core::PresentationMeasures::stroke_width_m},
                      {"max_speed_m_per_s", &core::PresentationMeasures::max_speed_m_per_s}};
  for (const auto& [name, value] : kMovements) {
    std::vector<core::PresentationRow> all;
    for (const auto& [block, rows] : participant.presentations) {
      if (const auto mean = movement_mean(rows, value)) {
        person.numbers[std::string(name) + "." + block] = *mean;
      }
      all.insert(all.end(), rows.begin(), rows.end());
    }
    if (const auto mean = movement_mean(all, value)) person.numbers[name] = *mean;
  }
}

}  // namespace

std::vector<PersonOutcome> person_outcomes(const StudyData& data) {
  std::vector<PersonOutcome> outcomes(data.participants.size());
  ByName people;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const ParticipantData& participant = data.participants[i];
    outcomes[i].cells = participant.cells;
    people[participant.participant] = &outcomes[i];
    add_movement(participant, outcomes[i]);
  }
  for (const BlockDesign& block : data.blocks) {
    if (block.compares()) add_counts(data, block, people);
    if (block.produces()) {
      add_means(production_block(data, block), block.block, people);
    }
    if (!block.estimates() || !block.counts_in_water()) continue;
    add_means(estimation_block(data, block), block.block, people);
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
      outcomes[i].numbers.merge(
          own_trial_correlations(data.participants[i].trials_in(block.block)));
    }
  }
  return outcomes;
}

}  // namespace jnd::analysis
