#include "analysis/results/unanswered_results.h"

#include <algorithm>
#include <cstdint>
#include <string>

#include "analysis/results/number_words.h"
#include "analysis/results/study_sections.h"
#include "analysis/results/threshold_group.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

/// If a larger share is missing, the remaining answers of a participant are doubtful. A tenth
/// is a convention.
constexpr double kOften = 0.1;

/// The answers that one participant left open in one block.
struct Unanswered {
  std::int64_t num_answers = 0;
  std::int64_t num_cannot_tell = 0;  ///< The number of answers "cannot tell".
  std::int64_t num_missed = 0;       ///< The number of answers that missed their deadline.

  [[nodiscard]] double cannot_tell_ratio() const {
    return static_cast<double>(num_cannot_tell) / static_cast<double>(num_answers);
  }
  /// The share of all requested answers. Each missed answer was asked for again.
  [[nodiscard]] double missed_ratio() const {
    return static_cast<double>(num_missed) / static_cast<double>(num_answers + num_missed);
  }
};

Unanswered unanswered_of(const ParticipantData& participant, const std::string& block) {
  Unanswered found;
  for (const auto* const list : {&participant.trials, &participant.catch_trials}) {
    for (const core::TrialRow& trial : *list) {
      if (trial.block != block) continue;
      ++found.num_answers;
      found.num_cannot_tell += trial.response ? 0 : 1;
    }
  }
  for (const TrialRecord& record : participant.records) {
    if (record.block == block) found.num_missed += record.num_missed_deadline;
  }
  return found;
}

std::string often_words(const Unanswered& found) {
  return said(
      "\"cannot tell\" in {} of {}; what is estimated rests on the others, in which the choice "
      "was easier, so that a Weber fraction or threshold comes out smaller than where "
      "everybody has to choose",
      std::to_string(found.num_cannot_tell), counted_words(found.num_answers, "answer"));
}

std::string missed_words(const Unanswered& found) {
  return said(
      "{} missed the deadline, {} did not; what is hard to answer takes longer, and was asked "
      "for once more",
      counted_words(found.num_missed, "answer"), std::to_string(found.num_answers));
}

}  // namespace

std::optional<ResultsSection> unanswered_results(const StudyData& data) {
  ResultsSection section{.name = "unanswered"};
  for (const BlockDesign& block : data.blocks) {
    const bool opens = block.written.cannot_tell;
    const bool has_deadline = block.written.answer_deadline_s.has_value();
    if (!opens && !has_deadline) continue;
    OwnNumbers cannot_tell, missed;
    for (const ParticipantData& participant : data.participants) {
      const std::string& who = participant.participant;
      const Unanswered found = unanswered_of(participant, block.block);
      const auto add = [&](const std::string& name, std::int64_t value) {
        section.participants.push_back(
            {who, block.block + "." + name, static_cast<double>(value), {}, ""});
      };
      if (opens && found.num_answers > 0) {
        add("num_cannot_tell", found.num_cannot_tell);
        cannot_tell[who] = found.cannot_tell_ratio();
      }
      if (has_deadline && found.num_answers + found.num_missed > 0) {
        add("num_missed_deadline", found.num_missed);
        missed[who] = found.missed_ratio();
      }
    }
    add_mean_rate(section,
                  {.name = block.block + ".cannot_tell_ratio",
                   .meaning = said("share of answers that were \"cannot tell\", which no curve "
                                   "and no rate has: mean over participants")},
                  cannot_tell);
    add_mean_rate(section,
                  {.name = block.block + ".missed_deadline_ratio",
                   .meaning = said("share of answers that missed their deadline, after which "
                                   "the trial was run again: mean over participants")},
                  missed);
  }
  if (section.participants.empty()) return std::nullopt;
  return section;
}

void caution_of_unanswered(StudyResults& results, const StudyData& data) {
  for (const BlockDesign& block : data.blocks) {
    const auto section =
        std::ranges::find(results.sections, block.block, &ResultsSection::name);
    if (section == results.sections.end()) continue;
    for (const ParticipantData& participant : data.participants) {
      const Unanswered found = unanswered_of(participant, block.block);
      const auto caution = [&](const std::string& words) {
        section->cautions.push_back({participant.participant, words});
      };
      if (found.num_answers > 0 && found.cannot_tell_ratio() > kOften)
        caution(often_words(found));
      if (found.num_answers > 0 && found.missed_ratio() > kOften) caution(missed_words(found));
    }
  }
}

}  // namespace jnd::analysis
