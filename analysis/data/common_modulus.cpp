#include "analysis/data/common_modulus.h"

#include <cmath>

#include "analysis/data/magnitude_means.h"

namespace jnd::analysis {
namespace {

constexpr double kPercent = 100.0;

void multiply(ParticipantData& participant, const std::string& block, double factor) {
  for (std::vector<core::TrialRow>* trials :
       {&participant.trials, &participant.excluded_trials}) {
    for (core::TrialRow& trial : *trials) {
      if (trial.block == block && trial.response) *trial.response *= factor;
    }
  }
}

}  // namespace

void bring_to_common_modulus(StudyData& data, BlockDesign& block) {
  if (!block.estimates() || block.counts_in_water()) return;
  if (!block.counts_in_own_numbers()) {
    const double modulus_value = block.written.settings.number("modulus_value", kPercent);
    for (ParticipantData& participant : data.participants) {
      multiply(participant, block.block, kPercent / modulus_value);
    }
    return;
  }
  const MagnitudeBlock answers = estimation_block(data, block);
  const auto moduli = answers.size() == 0 ? std::nullopt : log_moduli(answers);
  if (!moduli) return;
  for (ParticipantData& participant : data.participants) {
    for (std::size_t i = 0; i < answers.size(); ++i) {
      if (answers.names[i] != participant.participant) continue;
      // `answers` holds a hundredth of the numbers.
      block.own_log_moduli[answers.names[i]] = (*moduli)[i] + std::log(kPercent);
      multiply(participant, block.block, std::exp(-(*moduli)[i]));
    }
  }
}

}  // namespace jnd::analysis
