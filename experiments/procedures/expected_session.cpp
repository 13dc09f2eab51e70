#include "experiments/procedures/expected_session.h"

#include <type_traits>
#include <variant>

#include "experiments/procedures/practice.h"

namespace jnd::experiments {
namespace {

double total_duration_s(const std::vector<Exploration>& explorations) {
  double duration_s = 0.0;
  for (const Exploration& exploration : explorations) duration_s += exploration.duration_s;
  return duration_s;
}

double trials_duration_s(const Block& block, int num_trials) {
  return (block.free_space_between_s + block.expected_trial_s) * num_trials;
}

}  // namespace

double expected_duration_s(const Stage& stage, const ExpectedTimes& times) {
  return std::visit(
      [&](const auto& content) -> double {
        using Content = std::decay_t<decltype(content)>;
        if constexpr (std::is_same_v<Content, Checklist>) {
          return times.checklist_item_s * static_cast<double>(content.items.size());
        } else if constexpr (std::is_same_v<Content, Consent>) {
          return times.consent_paragraph_s * static_cast<double>(content.paragraphs.size());
        } else if constexpr (std::is_same_v<Content, Explore>) {
          return total_duration_s(content.media);
        } else if constexpr (std::is_same_v<Content, Training>) {
          return total_duration_s(content.examples);
        } else if constexpr (std::is_same_v<Content, Block>) {
          return trials_duration_s(content, expected_trials(content));
        } else if constexpr (std::is_same_v<Content, Break>) {
          return content.duration_s;
        } else if constexpr (std::is_same_v<Content, PostExperiment>) {
          return times.post_experiment_item_s * static_cast<double>(content.items.size());
        } else if constexpr (std::is_same_v<Content, Questionnaire>) {
          return times.questionnaire_item_s * static_cast<double>(content.items.size());
        } else {
          // A counterbalance takes no time itself, because participants' lists have its stages
          // instead.
          return 0.0;
        }
      },
      stage.content);
}

double longest_duration_s(const Stage& stage, const ExpectedTimes& times) {
  const auto* block = std::get_if<Block>(&stage.content);
  return block == nullptr ? expected_duration_s(stage, times)
                          : trials_duration_s(*block, most_trials(*block));
}

Stretch longest_stretch(const std::vector<StageInstance>& stages) {
  Stretch longest, current;
  for (const StageInstance& instance : stages) {
    if (std::holds_alternative<Break>(instance.stage->content)) current = {};
    const auto* block = std::get_if<Block>(&instance.stage->content);
    if (block == nullptr) continue;
    current.num_trials += expected_trials(*block);
    current.blocks.push_back(instance.stage);
    if (current.num_trials > longest.num_trials) longest = current;
  }
  return longest;
}

double expected_session_s(const std::vector<StageInstance>& stages) {
  double duration_s = 0.0;
  for (const StageInstance& instance : stages) {
    duration_s += expected_duration_s(*instance.stage);
  }
  return duration_s;
}

}  // namespace jnd::experiments
