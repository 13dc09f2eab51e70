#include "analysis/results/inverted_answers.h"

#include <algorithm>
#include <iterator>

#include "analysis/fits/falling_test.h"
#include "analysis/results/discrimination_answers.h"
#include "analysis/results/threshold_answers.h"
#include "analysis/statistics/falling_ranks.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

std::vector<InvertedAnswers> inverted_in(const StudyData& data, const BlockDesign& block) {
  std::vector<InvertedAnswers> found;
  std::vector<ExcludedParticipant> without_answers;
  const auto look_at = [&](const std::string& participant,
                           const std::vector<AnswerCount>& rows) {
    if (const auto p_value = significant_fall(rows)) {
      found.push_back({participant, block.block, *p_value});
    }
  };
  if (block.compares()) {
    for (const auto& one : discrimination_answers(data, block, false, without_answers)) {
      look_at(one.participant, one.rows());
    }
  } else if (block.detects()) {
    for (const auto& one : threshold_answers(data, block, false, without_answers)) {
      look_at(one.participant, one.rows_with_catches());
    }
  }
  return found;
}

/// The participants whose answers fall in a block of magnitudes, or of intensities set for
/// magnitudes.
std::vector<InvertedAnswers> falling_magnitudes_in(const StudyData& data,
                                                   const BlockDesign& block) {
  std::vector<InvertedAnswers> found;
  const bool is_production = block.produces();
  for (const ParticipantData& participant : data.participants) {
    std::vector<double> x, answers;
    for (const core::TrialRow& trial : participant.trials_in(block.block)) {
      const std::optional<double>& asked =
          is_production ? trial.target_percent : trial.intensity;
      if (!asked || !trial.response) continue;
      x.push_back(*asked);
      answers.push_back(*trial.response);
    }
    const std::optional<double> p_value = falling_ranks_p_value(x, answers);
    if (!p_value || !(*p_value < kFallingBelow)) continue;
    found.push_back({.participant = participant.participant,
                     .block = block.block,
                     .p_value = *p_value,
                     .is_estimation = !is_production,
                     .is_production = is_production});
  }
  return found;
}

bool has_magnitudes(const BlockDesign& block) { return block.estimates() || block.produces(); }

std::string test_words(const InvertedAnswers& one) {
  if (!one.is_estimation && !one.is_production) return falling_words(one.p_value);
  return said(
      "{} (one-sided rank correlation, {}), as of somebody who answers the wrong way round",
      std::string(one.is_production ? said("the intensities set fall as the target grows")
                                    : said("the answers fall as the intensity grows")),
      falling_p_words(one.p_value));
}

std::string left_out_words(const InvertedAnswers& one) {
  return said("left out as --inverted out asks, for {}", test_words(one));
}

/// Whether an estimate of a block rests on everybody's answers.
bool has_everybody(const Estimate& estimate, const std::string& block) {
  if (estimate.name.ends_with(".without_degenerate")) return false;
  return std::ranges::any_of(
      std::initializer_list<const char*>{".weber_fraction", ".slope_sd", ".pse", ".lapse_rate",
                                         ".staircase_threshold", ".staircase_weber_fraction",
                                         ".limits_", ".quest_plus_"},
      [&](const char* start) { return estimate.name.starts_with(block + start); });
}

/// A caution such as "P03 and P07, who answer the wrong way round, are in it: ...", for one or
/// more people.
std::string in_it_words(const std::vector<std::string>& people) {
  std::string names;
  for (std::size_t i = 0; i < people.size(); ++i) {
    names += (i == 0 ? "" : i + 1 == people.size() ? said(" and ") : ", ") + people[i];
  }
  const bool one = people.size() == 1;
  return said("{}{} the wrong way round, {} in it: --inverted out leaves {} out", names,
              (one ? said(", who answers") : said(", who answer")),
              (one ? said("is") : said("are")), (one ? said("this person") : said("them")));
}

std::string people_of(const std::vector<InvertedAnswers>& all, const std::string& block,
                      std::vector<std::string>& people) {
  for (const InvertedAnswers& one : all) {
    const bool is_new = std::ranges::find(people, one.participant) == people.end();
    if (one.block == block && is_new) people.push_back(one.participant);
  }
  return people.empty() ? "" : in_it_words(people);
}

/// Whether an estimate of a section includes this person's answers.
bool has_person(const ResultsSection& section, const Estimate& estimate,
                const std::string& person) {
  // Means of own exponents include only people who have one.
  const std::size_t at = estimate.name.find(".individual_a_");
  if (at == std::string::npos) return true;
  return std::ranges::any_of(section.participants, [&](const ParticipantEstimate& own) {
    return own.participant == person && own.value &&
           own.name == estimate.name.substr(0, at) + ".a";
  });
}

/// Adds cautions in a block of magnitudes, where every number except a count is a mean or a fit
/// of everybody's answers.
void mark_magnitudes(ResultsSection& section, const std::vector<std::string>& people) {
  for (Estimate& estimate : section.estimates) {
    if (estimate.name.ends_with(".num_zeros")) continue;
    std::vector<std::string> in_it = people;
    std::erase_if(in_it, [&](const std::string& person) {
      return !has_person(section, estimate, person);
    });
    if (!in_it.empty()) estimate.cautions.push_back(in_it_words(in_it));
  }
}

void mark_group(StudyResults& results, const std::vector<InvertedAnswers>& all,
                const BlockDesign& block) {
  std::vector<std::string> people;
  const std::string words = people_of(all, block.block, people);
  if (words.empty()) return;
  for (ResultsSection& section : results.sections) {
    if (has_magnitudes(block)) {
      if (section.name == block.block) mark_magnitudes(section, people);
      continue;
    }
    for (Estimate& estimate : section.estimates) {
      if (has_everybody(estimate, block.block)) estimate.cautions.push_back(words);
    }
  }
}

/// Adds cautions to the combination of estimation and production, which uses people who have
/// both.
void mark_combined(StudyResults& results, const std::vector<InvertedAnswers>& all) {
  for (ResultsSection& section : results.sections) {
    if (section.name != "combined") continue;
    std::vector<std::string> people;
    for (const InvertedAnswers& one : all) {
      if (!one.is_estimation && !one.is_production) continue;
      bool is_in_it = false;
      for (ParticipantEstimate& own : section.participants) {
        if (own.participant != one.participant) continue;
        is_in_it = true;
        if (own.value) own.cautions.push_back(one.block + ": " + test_words(one));
      }
      const bool is_new = std::ranges::find(people, one.participant) == people.end();
      if (is_in_it && is_new) people.push_back(one.participant);
    }
    if (people.empty()) continue;
    for (Estimate& estimate : section.estimates) {
      estimate.cautions.push_back(in_it_words(people));
    }
    // People without an own exponent are among the excluded.
    std::erase_if(people, [&](const std::string& person) {
      return std::ranges::any_of(section.excluded, [&](const ExcludedParticipant& one) {
        return one.participant == person && one.reason.starts_with("own exponents");
      });
    });
    if (people.empty()) continue;
    for (NamedComparison& named : section.comparisons) {
      named.cautions.push_back(in_it_words(people));
    }
  }
}

/// Adds cautions to the hierarchical tests. The tests of people's own fractions do not include
/// these people, because they have no fraction.
void mark_tests(StudyResults& results, const std::vector<InvertedAnswers>& all) {
  constexpr std::string_view kAgainst = "_against_";
  for (ResultsSection& section : results.sections) {
    const std::size_t at = section.name.find(kAgainst);
    if (at == std::string::npos) continue;
    std::vector<std::string> people;
    (void)people_of(all, section.name.substr(0, at), people);
    const std::string words = people_of(all, section.name.substr(at + kAgainst.size()), people);
    if (words.empty()) continue;
    for (NamedComparison& named : section.comparisons) {
      if (named.name.find(", hierarchical") != std::string::npos) {
        named.cautions.push_back(words);
      }
    }
  }
}

}  // namespace

std::vector<InvertedAnswers> inverted_answers(const StudyData& data) {
  std::vector<InvertedAnswers> all;
  for (const BlockDesign& block : data.blocks) {
    std::ranges::move(
        has_magnitudes(block) ? falling_magnitudes_in(data, block) : inverted_in(data, block),
        std::back_inserter(all));
  }
  return all;
}

void leave_out_inverted(StudyData& data) {
  for (const InvertedAnswers& one : inverted_answers(data)) {
    for (ParticipantData& participant : data.participants) {
      if (participant.participant != one.participant) continue;
      const auto set_aside = [&](std::vector<core::TrialRow>& trials) {
        const auto kept = std::stable_partition(
            trials.begin(), trials.end(),
            [&](const core::TrialRow& trial) { return trial.block != one.block; });
        std::move(kept, trials.end(), std::back_inserter(participant.excluded_trials));
        trials.erase(kept, trials.end());
      };
      set_aside(participant.trials);
      set_aside(participant.catch_trials);
      participant.left_out[one.block] = one.block + ": " + left_out_words(one);
    }
    for (AdaptiveRun& run : data.runs) {
      const bool is_theirs = run.participant == one.participant && run.block == one.block;
      if (is_theirs) run.problem = left_out_words(one);
    }
  }
}

void caution_of_inverted(StudyResults& results, const StudyData& data) {
  const std::vector<InvertedAnswers> all = inverted_answers(data);
  for (const InvertedAnswers& one : all) {
    for (ResultsSection& section : results.sections) {
      if (section.name != one.block) continue;
      section.cautions.push_back({one.participant, one.block + ": " + test_words(one)});
      for (ParticipantEstimate& own : section.participants) {
        const bool is_theirs = own.participant == one.participant && own.value.has_value();
        if (is_theirs) own.cautions.push_back(test_words(one));
      }
    }
  }
  for (const BlockDesign& block : data.blocks) mark_group(results, all, block);
  mark_combined(results, all);
  mark_tests(results, all);
}

}  // namespace jnd::analysis
