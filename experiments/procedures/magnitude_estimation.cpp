#include "experiments/procedures/magnitude_estimation.h"

#include "experiments/procedures/repetitions.h"

namespace jnd::experiments {
namespace {

constexpr char kStandardWord[] = "standard";

std::vector<Condition> with_standard() { return {{"modulus", {kStandardWord}}}; }

BlockKey modulus_key() {
  return {.parameter = {
              .key = "modulus",
              .kind = ValueKind::kString,
              .meaning = "What the numbers count in. `water_is_100`: percent, real water being "
                         "100 and free space 0. `standard`: the standard is felt and counts as "
                         "`modulus_value`. `free`: everybody chooses their own numbers; the "
                         "analysis equalises their moduli. With the last two a number is above "
                         "0, and nothing is compared in percent of water.",
              .required = false,
              .default_json = R"("water_is_100")",
              .allowed = {"water_is_100", kStandardWord, "free"}}};
}

}  // namespace

std::string MagnitudeEstimation::meaning() const {
  return "The participant says how strong each stimulus feels, as a number.";
}

std::vector<BlockKey> MagnitudeEstimation::keys() const {
  std::vector<BlockKey> keys = {stimuli_key(), repetitions_key(), order_key(),
                                max_returns_key(), modulus_key()};
  for (BlockKey& standard : standard_keys()) keys.push_back(std::move(standard));
  keys.push_back({.parameter = {.key = "modulus_value",
                                .kind = ValueKind::kNumber,
                                .meaning = "The number that the standard counts as.",
                                .required = false,
                                .default_json = "100.0",
                                .range = {0.0, 1e6, true},
                                .only_where = with_standard()}});
  keys.push_back({.parameter = {.key = "standard_every_trials",
                                .kind = ValueKind::kInteger,
                                .meaning = "The standard is felt in the first of so many "
                                           "trials: 1 is in every trial.",
                                .required = false,
                                .default_json = "1",
                                .range = {1, 1000},
                                .only_where = with_standard()}});
  return keys;
}

std::vector<std::string> MagnitudeEstimation::examples() const {
  return {R"json({"kind": "block", "name": "how_strong",
  "procedure": "magnitude_estimation", "medium": "water", "scale": [0, 0.5, 1, 2, 4], "repetitions": 3,
  "instruction": {"en": "Real water is 100 percent, free space is 0."},
  "question": {"en": "How strong, in percent of water?"},
  "free_space_between_s": 2, "expected_trial_s": 15})json"};
}

Modulus modulus_of(const Block& block) {
  if (!block.settings.has("modulus")) return Modulus::kWater;
  const std::string& word = block.settings.word("modulus");
  return word == kStandardWord ? Modulus::kStandard
         : word == "free"      ? Modulus::kFree
                               : Modulus::kWater;
}

TrialForm MagnitudeEstimation::form(const Block& block) const {
  const Modulus modulus = modulus_of(block);
  return {.answer = modulus == Modulus::kWater ? AnswerKind::kPercent : AnswerKind::kNumber,
          .has_reference = modulus == Modulus::kStandard};
}

std::vector<PlannedTrial> MagnitudeEstimation::draw_next(
    const Block& block, const std::vector<AnsweredTrial>& answered,
    core::RandomStream& stream) const {
  if (!answered.empty()) return {};
  std::vector<PlannedTrial> trials = ordered_repetitions(
      block, block.repetitions, stream,
      [](int, double intensity) { return PlannedTrial{.intensity = intensity}; });
  if (modulus_of(block) != Modulus::kStandard) return trials;
  const auto every = static_cast<std::size_t>(block.settings.integer("standard_every_trials"));
  for (std::size_t i = 0; i < trials.size(); i += every) {
    trials[i].reference_intensity = block.standards.at(0);
  }
  return trials;
}

int MagnitudeEstimation::expected_trials(const Block& block) const {
  return block.repetitions * static_cast<int>(block.intensities.size());
}

}  // namespace jnd::experiments
