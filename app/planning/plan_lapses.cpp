#include "app/planning/plan_lapses.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "analysis/fits/psychometric_fit.h"
#include "analysis/results/block_words.h"
#include "app/command_line/json_text.h"
#include "core/error.h"
#include "core/psychometric_function.h"
#include "experiments/participants/median_person.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/procedures/stimulus.h"
#include "experiments/procedures/task.h"
#include "experiments/study/media.h"

namespace jnd::app {
namespace {

using namespace experiments;

constexpr double kLapseRate = 0.03;

/// How often each level comes, for everybody together.
struct Asked {
  const Stage* stage = nullptr;
  std::map<double, double> num_trials;
};

bool is_compared(const Block& block) {
  return !block.practice && !analysis::length_is_expected(block) &&
         !block.intensities.empty() && block.reference_intensity.value_or(0.0) > 0.0 &&
         procedure_named(block.procedure).measures(block) == Measure::kComparison;
}

std::vector<Asked> asked_in(const std::vector<ParticipantPlan>& plans) {
  std::vector<Asked> all;
  for (const ParticipantPlan& plan : plans) {
    for (const PlannedBlock& block : plan.blocks) {
      if (!is_compared(std::get<Block>(block.stage->content))) continue;
      auto found = std::ranges::find_if(
          all, [&](const Asked& one) { return one.stage->name == block.stage->name; });
      if (found == all.end()) found = all.insert(all.end(), {.stage = block.stage});
      for (const PlannedTrial& trial : block.trials) {
        if (!trial.is_catch && trial.intensity.value_or(0.0) > 0.0) {
          ++found->num_trials[*trial.intensity];
        }
      }
    }
  }
  return all;
}

/// The log-likelihood and the Weber fraction of the answers that such people would give on
/// average.
analysis::PsychometricFit expected_fit(const Asked& asked, double reference, double fraction,
                                       bool free_lapse) {
  // Multiplies the trials, so that shares of answers become whole numbers.
  constexpr double kManyTimes = 1e4;
  std::vector<analysis::AnswerCount> rows;
  for (const auto& [intensity, num] : asked.num_trials) {
    const double z = std::log(intensity / reference) / std::log1p(fraction);
    const double yes = kLapseRate + (1.0 - 2.0 * kLapseRate) * core::standard_normal_cdf(z);
    rows.push_back({intensity, std::llround(kManyTimes * num * yes),
                    static_cast<std::int64_t>(kManyTimes * num)});
  }
  analysis::PsychometricFit fit =
      analysis::fit_psychometric(rows, {.reference = reference,
                                        .free_pse = true,
                                        .free_lapse = free_lapse,
                                        .intervals = false,
                                        .solver = analysis::Solver::kNewton});
  if (fit.log_likelihood) fit.log_likelihood = *fit.log_likelihood / kManyTimes;
  return fit;
}

std::optional<PlannedLapses> lapses_of(const Asked& asked, const Laboratory& laboratory,
                                       const core::ForceMap* map) {
  constexpr double kVeryEasy = 2.5;
  const auto& block = std::get<Block>(asked.stage->content);
  if (block.is_pressed() && !laboratory.pressing) return std::nullopt;
  PlannedLapses lapses{.block = asked.stage->name, .quantity = block.quantity};
  const double reference = *block.reference_intensity;
  try {
    lapses.weber_fraction = median_curve_fraction(laboratory, block, map);
  } catch (const core::Error&) {
    // Nobody in the laboratory answers such a block; the durations say so.
    return std::nullopt;
  }
  if (!(lapses.weber_fraction > 0.0) || !std::isfinite(lapses.weber_fraction)) {
    return std::nullopt;
  }
  const double step = std::log1p(lapses.weber_fraction);
  for (const auto& [intensity, num] : asked.num_trials) {
    lapses.easiest_ratio =
        std::max(lapses.easiest_ratio,
                 core::standard_normal_cdf(std::fabs(std::log(intensity / reference) / step)));
  }
  const auto without = expected_fit(asked, reference, lapses.weber_fraction, false);
  const auto with = expected_fit(asked, reference, lapses.weber_fraction, true);
  if (!without.weber_fraction || !without.log_likelihood || !with.log_likelihood) {
    return std::nullopt;
  }
  lapses.fraction_change = *without.weber_fraction / lapses.weber_fraction - 1.0;
  lapses.expected_rise = std::max(0.0, *with.log_likelihood - *without.log_likelihood);
  lapses.easy_low = reference * std::exp(-kVeryEasy * step);
  lapses.easy_high = reference * std::exp(kVeryEasy * step);
  return lapses;
}

}  // namespace

std::vector<PlannedLapses> planned_lapses(const Study& study,
                                          const std::vector<ParticipantPlan>& plans,
                                          const Laboratory& laboratory) {
  const std::unique_ptr<const core::ForceMap> map = force_map_of(study.device);
  std::vector<PlannedLapses> all;
  for (const Asked& asked : asked_in(plans)) {
    if (const auto lapses = lapses_of(asked, laboratory, map.get())) all.push_back(*lapses);
  }
  return all;
}

void add_to_json(const std::vector<PlannedLapses>& lapses, nlohmann::ordered_json& json) {
  constexpr int kNumDecimals = 6;
  json["lapses"] = nlohmann::ordered_json::array();
  for (const PlannedLapses& one : lapses) {
    json["lapses"].push_back(
        {{"block", one.block},
         {"quantity", one.quantity},
         {"weber_fraction", to_decimals(one.weber_fraction, kNumDecimals)},
         {"easiest_ratio", to_decimals(one.easiest_ratio, kNumDecimals)},
         {"lapse_rate", kLapseRate},
         {"fraction_change", to_decimals(one.fraction_change, kNumDecimals)},
         {"expected_rise", to_decimals(one.expected_rise, kNumDecimals)},
         {"untold", one.are_untold()},
         {"easy_low", to_decimals(one.easy_low, kNumDecimals)},
         {"easy_high", to_decimals(one.easy_high, kNumDecimals)}});
  }
}

void print(const std::vector<PlannedLapses>& lapses) {
  if (std::ranges::none_of(lapses, &PlannedLapses::are_untold)) return;
  fmt::print("\nLevels too hard to tell lapses, answers at random, from a flat curve\n");
  for (const PlannedLapses& one : lapses) {
    if (!one.are_untold()) continue;
    fmt::print(
        "  {}: simulated participants, w = {:.2f}, are right in {:.0f} % at the easiest level; "
        "a lapse rate of {:g} would go unnoticed and make the Weber fraction {:.0f} % too "
        "large; add levels up to {:.3g} or from {:.3g} {}, which are right in 99 %\n",
        one.block, one.weber_fraction, 100.0 * one.easiest_ratio, kLapseRate,
        100.0 * one.fraction_change, one.easy_low, one.easy_high,
        experiments::quantity_unit(one.quantity));
  }
}

}  // namespace jnd::app
