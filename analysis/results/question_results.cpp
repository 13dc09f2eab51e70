#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/data/planned_trials.h"
#include "analysis/data/stored_studies.h"
#include "analysis/results/magnitude_section.h"
#include "analysis/results/rated_answers.h"
#include "analysis/results/study_results.h"
#include "analysis/words/said.h"
#include "experiments/study/question_answer.h"

namespace jnd::analysis {
namespace {

using Item = experiments::QuestionnaireItem;

/// The trials of a block that a participant answered, including catch trials.
std::vector<const core::TrialRow*> trials_of(const ParticipantData& participant,
                                             const std::string& block) {
  std::vector<const core::TrialRow*> trials;
  for (const auto* const list : {&participant.trials, &participant.catch_trials}) {
    for (const core::TrialRow& trial : *list) {
      if (trial.block == block) trials.push_back(&trial);
    }
  }
  return trials;
}

RatedAnswer rated(const BlockDesign& block, const core::TrialRow& trial, double value) {
  RatedAnswer answer{.value = value, .was_right = was_right(block.written, trial)};
  if (!trial.is_catch) answer.level = trial.intensity;
  const bool is_ratio = block.compares() || block.tells_apart() || block.identifies();
  if (is_ratio && trial.intensity.value_or(0.0) > 0.0 &&
      trial.reference_intensity.value_or(0.0) > 0.0) {
    answer.distance_ln = std::abs(std::log(*trial.intensity / *trial.reference_intensity));
  }
  return answer;
}

/// The meaning of a step, such as "step from 1, “I guessed”, to 5, “wholly sure”: How sure are
/// you?".
std::string words_of(const Item& item) {
  std::string question = in_spoken_language(item.question);
  if (item.kind == "yes_no") return said("1 being yes and 0 no: {}", question);
  if (item.kind != "scale") return question;
  return said("step from 1, “{}”, to {}, “{}”: {}", in_spoken_language(item.low_label),
              std::to_string(item.num_steps), in_spoken_language(item.high_label), question);
}

class QuestionSection {
 public:
  QuestionSection(const StudyData& data, const BlockDesign& block)
      : data_(data), block_(block), section_{.name = block.block + "_questions"} {}

  void add(const Item& item) {
    if (item.kind == "choice" || item.kind == "yes_no_which") add_shares(item);
    if (item.kind == "text" || item.kind == "yes_no_which") add_free_answers(item);
    if (!experiments::has_value(item)) return;
    RatedAnswers answers;
    for_each_answer(item, [&](const ParticipantData& participant, const core::TrialRow& trial,
                              const std::string& given) {
      if (const std::optional<double> value = experiments::value_of_answer(given)) {
        answers[participant.participant].push_back(rated(block_, trial, *value));
      }
    });
    if (answers.empty()) return;
    add_rated(section_,
              {.prefix = prefix_of(item),
               .words = words_of(item),
               .unit = item.unit.empty() ? "1" : item.unit,
               .has_fixed_levels = block_.has_fixed_levels()},
              answers);
  }

  [[nodiscard]] ResultsSection finish() && {
    for (const ParticipantData& participant : data_.participants) {
      const auto asked = static_cast<std::int64_t>(trials_of(participant, block_.block).size() *
                                                   block_.written.questions.size());
      const auto given = std::ranges::count_if(
          participant.question_answers, [&](const core::QuestionAnswerRow& row) {
            return row.block == block_.block && row.answer != experiments::kNoAnswer;
          });
      if (given >= asked) continue;
      section_.excluded.push_back(
          {participant.participant,
           said("{}: {} of {} questions after trials were not answered", block_.block,
                std::to_string(asked - given), std::to_string(asked))});
    }
    return std::move(section_);
  }

 private:
  [[nodiscard]] std::string prefix_of(const Item& item) const {
    return block_.block + ".question." + item.name;
  }

  template <typename Visit>
  void for_each_answer(const Item& item, Visit visit) const {
    for (const ParticipantData& participant : data_.participants) {
      std::map<std::pair<std::int64_t, std::int64_t>, const std::string*> given;
      for (const core::QuestionAnswerRow& row : participant.question_answers) {
        if (row.question == item.name && row.block == block_.block) {
          given[{row.session, row.trial}] = &row.answer;
        }
      }
      for (const core::TrialRow* const trial : trials_of(participant, block_.block)) {
        const auto found = given.find({trial->session, trial->trial});
        if (found != given.end()) visit(participant, *trial, *found->second);
      }
    }
  }

  /// Adds how often each answer was given, as the mean over participants of their shares.
  void add_shares(const Item& item) {
    std::vector<std::string> options = {"yes", "no"};
    if (item.kind == "choice") {
      options.clear();
      for (const experiments::Option& option : item.options) options.push_back(option.value);
    }
    std::map<std::string, std::map<std::string, int>> counts;
    for_each_answer(item, [&](const ParticipantData& participant, const core::TrialRow&,
                              const std::string& given) {
      if (given == experiments::kNoAnswer) return;
      ++counts[participant.participant][given.starts_with("yes: ") ? "yes" : given];
    });
    for (const std::string& option : options) {
      std::vector<double> shares;
      for (auto& [participant, own] : counts) {
        int all = 0;
        for (const auto& [answer, count] : own) all += count;
        shares.push_back(static_cast<double>(own[option]) / all);
      }
      add_mean(section_, prefix_of(item) + "." + option,
               said("share of trials answered \"{}\", mean of the participants' own: {}",
                    option, in_spoken_language(item.question)),
               shares);
    }
  }

  void add_free_answers(const Item& item) {
    for_each_answer(item, [&](const ParticipantData& participant, const core::TrialRow& trial,
                              const std::string& given) {
      const bool which = item.kind == "yes_no_which";
      if (given == experiments::kNoAnswer || (which && !given.starts_with("yes: "))) return;
      section_.free_answers.push_back({participant.participant, block_.block + "." + item.name,
                                       in_spoken_language(item.question),
                                       said("trial {}: {}", std::to_string(trial.trial),
                                            (which ? given.substr(5) : given))});
    });
  }

  const StudyData& data_;
  const BlockDesign& block_;
  ResultsSection section_;
};

}  // namespace

ResultsSection question_results(const StudyData& data, const BlockDesign& block) {
  QuestionSection section(data, block);
  for (const Item& item : block.written.questions) section.add(item);
  return std::move(section).finish();
}

ResultsSection rating_results(const StudyData& data, const BlockDesign& block) {
  ResultsSection section{.name = block.block};
  RatedAnswers answers;
  for (const ParticipantData& participant : data.participants) {
    for (const core::TrialRow& trial : participant.trials_in(block.block)) {
      if (trial.response) {
        answers[participant.participant].push_back(
            {.value = *trial.response, .level = trial.intensity});
      }
    }
    if (!answers.contains(participant.participant)) {
      name_without_answers(section.excluded, participant, block.block);
    }
  }
  if (answers.empty()) return section;
  const RatedName name{
      .prefix = block.block + ".rating",
      .words =
          said("step from 1, “{}”, to {}, “{}”", in_spoken_language(block.written.low_label),
               number_text(block.written.settings.number("num_steps", 10.0)),
               in_spoken_language(block.written.high_label)),
      .has_fixed_levels = true};
  add_rated(section, name, answers);
  add_trend_per_doubling(section, name, answers);
  return section;
}

}  // namespace jnd::analysis
