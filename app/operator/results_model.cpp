#include "app/operator/results_model.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "analysis/charts/charts.h"
#include "analysis/data/study_data.h"
#include "analysis/fits/bounded_interval.h"
#include "analysis/results/block_words.h"
#include "analysis/results/number_words.h"
#include "app/language/words.h"
#include "app/operator/study_folder.h"
#include "app/operator/study_words.h"
#include "app/preregistration/deviations.h"
#include "app/results/published_words.h"
#include "app/results/results_output.h"
#include "app/results/statistic_words.h"
#include "app/session/stored_session.h"
#include "core/error.h"
#include "core/storage/recording.h"
#include "core/storage/study_store.h"
#include "experiments/procedures/practice.h"
#include "experiments/study/stage_walk.h"

namespace jnd::app {
namespace {

using namespace results;
using analysis::Estimate;
using analysis::Interval;
using Tone = QualityChip::Tone;

std::string number(double value, const std::string& unit) {
  return fmt::format("{:.3g}{}{}", value, unit.empty() || unit == "1" ? "" : " ",
                     unit == "1" ? "" : unit);
}

/// The interval in words, such as "95 % 0.38 to 1.04"; "" if both ends are open.
std::string open_interval_words(const Interval& ci95) {
  if (!ci95.low && !ci95.high) return "";
  if (!ci95.low) return tr("95 % below {:.3g}", *ci95.high);
  if (!ci95.high) return tr("95 % above {:.3g}", *ci95.low);
  return tr("95 % {:.3g} to {:.3g}", *ci95.low, *ci95.high);
}

std::string published_words(const Estimate& estimate) {
  if (estimate.published_positive) return "> 0";
  if (!estimate.published) return "";
  return number(*estimate.published, estimate.unit) +
         (estimate.published_sd ? fmt::format(" ± {:.3g}", *estimate.published_sd) : "");
}

std::string p_words(double p_value) {
  return p_value < 0.0001 ? "p < 0.0001" : fmt::format("p = {:.4f}", p_value);
}

std::string comparison_words(const analysis::NamedComparison& named) {
  const analysis::Comparison& c = named.comparison;
  if (c.status != analysis::FitStatus::kOk) return c.reason;
  std::string words = open_interval_words(analysis::bounded_by_data(c.ci95, c.estimate));
  const auto add = [&words](const std::string& part) {
    words += (words.empty() ? "" : ", ") + part;
  };
  if (named.ratio()) {
    add(tr("{} {} times as large", named.ratio_of, fmt::format("{:.3g}", *named.ratio())));
  }
  if (c.statistic) add(statistic_words(c));
  if (c.p_value) add(p_words(*c.p_value));
  if (named.p_value_holm) add(tr("Holm {}", p_words(*named.p_value_holm)));
  if (!named.family.empty()) add(named.family);
  for (const std::string& caution : named.cautions) add(tr("caution: {}", caution));
  return words;
}

/// Such as "held out, tail 0.004 below"; the tail is told if simulated studies are known.
std::string basis_words(const analysis::StudyResults& results, const Estimate& estimate) {
  if (!results.simulated || !estimate.published) return "";
  const std::string tail = tail_words(estimate, results.predictive);
  return basis_of(estimate) + (tail.empty() ? "" : tr(", tail {}", tail));
}

/// A comparison's name with titles: "group_d - group_e: stroke_width_m, paired" becomes "Group
/// D - Group E: stroke width [m], paired".
std::string with_titles(const ResultsSource& source, std::string name) {
  for (const auto& [column, words] : {std::pair{"stroke_width_m", tr("stroke width [m]")},
                                      {"max_speed_m_per_s", tr("largest speed [m/s]")}}) {
    const std::size_t at = name.find(column);
    if (at != std::string::npos) name.replace(at, std::string(column).size(), words);
  }
  const std::size_t colon = name.find(": ");
  const std::size_t dash = name.find(" - ");
  if (colon == std::string::npos || dash == std::string::npos || dash > colon) return name;
  return short_title(source.title(name.substr(0, dash))) + " - " +
         short_title(source.title(name.substr(dash + 3, colon - dash - 3))) +
         name.substr(colon);
}

/// A section's name in words. It is a block's title; or, for what else is computed of a block
/// "low", such as "low_staircase", "Low: staircase". The catalogue has these words from
/// `analysis/words/said.cpp`. Reports say more, see `analysis::section_title`.
std::string section_words(const ResultsSource& source, const std::string& name) {
  const auto found = source.titles.find(name);
  if (found != source.titles.end()) return found->second;
  for (const auto& [block, title] : source.titles) {
    if (!name.starts_with(block + "_")) continue;
    return title + ": " +
           tr(name_words(name.substr(block.size() + 1), /*as_title=*/false).c_str());
  }
  return tr(name_words(name, /*as_title=*/true).c_str());
}

/// The words of a question's estimate: "questionnaire.solid_is_solid.yes" becomes "Is it solid?
/// yes". "" for other estimates.
std::string label_of_question(const ResultsSource& source, const std::string& name) {
  constexpr std::string_view kStart = "questionnaire.";
  if (!name.starts_with(kStart)) return "";
  const std::size_t dot = name.find('.', kStart.size());
  const auto question = source.questions.find(
      name.substr(kStart.size(), dot == std::string::npos ? dot : dot - kStart.size()));
  if (question == source.questions.end()) return "";
  if (dot == std::string::npos) return question->second;
  return question->second + " " + name_words(name.substr(dot + 1), /*as_title=*/false);
}

/// An estimate's name in words, without its block, which is shown above it.
std::string label_of(const ResultsSource& source, const std::string& name) {
  if (std::string label = label_of_question(source, name); !label.empty()) return label;
  const std::size_t dot = name.find('.');
  const bool is_own = dot != std::string::npos && source.titles.contains(name.substr(0, dot));
  return name_words(is_own ? name.substr(dot + 1) : name, /*as_title=*/true);
}

/// The meaning, such as "primary value: median person's w ...". It adds why there is no value,
/// and what the published value is.
std::string meaning_words(const Estimate& estimate) {
  const std::string& published = estimate.published_statistic;
  const bool says_more = !published.empty() && published != estimate.meaning;
  return (estimate.primary ? tr("primary value: {}", estimate.meaning) : estimate.meaning) +
         (estimate.reason.empty() ? "" : tr("; no value: {}", estimate.reason)) +
         (says_more ? tr("; published: {}", published) : "");
}

void add_numbers(const ResultsSource& source, ResultsModel& model) {
  for (const analysis::ResultsSection& section : source.results.sections) {
    for (const Estimate& estimate : section.estimates) {
      model.numbers.push_back(
          {.section = section_words(source, section.name),
           .label = label_of(source, estimate.name),
           .name = estimate.name,
           .value = estimate.value && std::isfinite(*estimate.value)
                        ? number(*estimate.value, estimate.unit)
                        : "",
           .interval = open_interval_words(
               analysis::told_interval(estimate.name, estimate.ci95, estimate.value)),
           .published = published_words(estimate),
           .meaning = meaning_words(estimate),
           .basis = basis_words(source.results, estimate),
           .caution = fmt::format("{}", fmt::join(estimate.cautions, "; "))});
    }
    for (const analysis::NamedComparison& named : section.comparisons) {
      model.comparisons.push_back({.name = with_titles(source, named.name),
                                   .estimate = named.comparison.estimate,
                                   .detail = comparison_words(named),
                                   .is_primary = named.primary});
    }
  }
  std::stable_partition(model.comparisons.begin(), model.comparisons.end(),
                        [](const ComparisonLine& line) { return line.is_primary; });
  // Planned contrasts come before everything else.
  std::vector<ComparisonLine> planned;
  for (const analysis::ContrastResult& one : source.results.contrasts) {
    std::string name = one.plan.name;
    std::ranges::replace(name, '_', ' ');
    planned.push_back(
        {.name = one.plan.primary ? tr("Planned, primary: {}", name) : tr("Planned: {}", name),
         .estimate = one.test.effect,
         .detail = one.sentence.empty() ? one.test.reason : one.sentence,
         .is_primary = one.plan.primary});
  }
  model.comparisons.insert(model.comparisons.begin(), planned.begin(), planned.end());
}

/// The number of trials, by block, that should have answers in a session, whether they are
/// drawn yet or not; practice does not count. If the answers decide how many trials there are,
/// a completed session has drawn them all.
std::map<std::string, std::int64_t> expected_trials(const experiments::Study& study,
                                                    const core::StudyStore& store,
                                                    const core::SessionRow& row) {
  std::map<std::string, std::int64_t> drawn;
  for (const core::DesignRow& trial : store.design(row.session)) ++drawn[trial.block];
  const bool is_over = store.completed(row.session);
  std::map<std::string, std::int64_t> expected;
  for (const experiments::Stage* stage : stages_of_session(study, row.cells)) {
    const auto* block = std::get_if<experiments::Block>(&stage->content);
    if (block == nullptr || block->practice) continue;
    expected[stage->name] = is_over && analysis::length_is_expected(*block)
                                ? drawn[stage->name]
                                : experiments::expected_trials(*block);
  }
  return expected;
}

/// What can be said about the data without decoding samples; a verification says the rest.
class Quality {
 public:
  Quality(const core::StudyStore& store, const experiments::Study& study) {
    for (const core::SessionRow& row : store.sessions()) {
      if (row.pilot) {
        ++num_pilots_;
        continue;
      }
      const auto expected = expected_trials(study, store, row);
      for (const auto& [block, num_trials] : expected) expected_ += num_trials;
      const auto num_of_data = [&expected](const std::vector<core::TrialRow>& trials) {
        return std::ranges::count_if(trials, [&](const core::TrialRow& trial) {
          return expected.contains(trial.block);
        });
      };
      const auto all = num_of_data(store.trials(row.session, /*include_excluded=*/true));
      answers_ += all;
      excluded_ += all - num_of_data(store.trials(row.session));
      open_ += store.finished(row.session) ? 0 : 1;
      if (row.recorded) look_at_recording(store.recording_file(row.session));
    }
  }

  void describe(const ResultsSource& source, std::vector<QualityChip>& chips) const {
    const analysis::StudyResults& results = source.results;
    if (results.simulated) {
      chips.push_back({results.laboratory_changed ? tr("simulated data, laboratory changed")
                                                  : tr("simulated data"),
                       Tone::kWarning});
    }
    const analysis::PreregisteredStudy& plan = results.preregistration;
    if (!plan.registered_on.empty()) {
      const std::size_t num = plan.deviations.size();
      chips.push_back(num == 0 ? QualityChip{tr("as preregistered"), Tone::kGood}
                               : QualityChip{trn("{} deviation from the preregistration",
                                                 "{} deviations from the preregistration", num),
                                             Tone::kWarning});
    }
    chips.push_back({tr("{} of {} answers", answers_, expected_),
                     answers_ >= expected_ ? Tone::kGood : Tone::kWarning});
    describe_recordings(chips);
    if (open_ > 0) {
      chips.push_back(
          {trn("{} session not finished", "{} sessions not finished", open_), Tone::kWarning});
    }
    if (excluded_ > 0) {
      chips.push_back(
          {trn("{} trial set aside", "{} trials set aside", excluded_), Tone::kWarning});
    }
    if (num_pilots_ > 0) {
      chips.push_back(
          {trn("{} pilot left out", "{} pilots left out", num_pilots_), Tone::kNeutral});
    }
    std::set<std::string> known;
    for (const analysis::ResultsSection& section : results.sections) {
      for (const analysis::Caution& one : section.cautions) {
        const std::string text = source.in_titles(one.participant + ": " + one.caution);
        if (known.insert(text).second) chips.push_back({text, Tone::kWarning});
      }
      for (const analysis::ExcludedParticipant& one : section.excluded) {
        // For a single participant, the same is said under their own name.
        if (one.participant == "everyone" && results.num_participants == 1) continue;
        const std::string text = source.in_titles(one.participant + ": " + one.reason);
        if (known.insert(text).second) chips.push_back({text, Tone::kWarning});
      }
    }
  }

 private:
  void look_at_recording(const std::filesystem::path& file) {
    ++num_recordings_;
    try {
      missing_ticks_ += core::RecordingReader(file).missing_ticks();
    } catch (const core::Error&) {
      ++unreadable_;
    }
  }

  void describe_recordings(std::vector<QualityChip>& chips) const {
    if (num_recordings_ == 0)
      return chips.push_back({tr("no recordings kept"), Tone::kNeutral});
    const std::string recordings = trn("{} recording", "{} recordings", num_recordings_);
    if (unreadable_ > 0) {
      chips.push_back({tr("{} of {} cannot be read", unreadable_, recordings), Tone::kWarning});
    }
    if (missing_ticks_ > 0) {
      chips.push_back(
          {tr("{} missing in {}", trn("{} sample", "{} samples", missing_ticks_), recordings),
           Tone::kWarning});
    } else if (unreadable_ == 0) {
      chips.push_back({tr("no gap in {}", recordings), Tone::kGood});
    }
  }

  std::int64_t expected_ = 0, answers_ = 0, excluded_ = 0, open_ = 0, num_pilots_ = 0;
  std::int64_t num_recordings_ = 0, missing_ticks_ = 0, unreadable_ = 0;
};

std::map<std::string, std::string> titles_of(const experiments::Study& study,
                                             const std::vector<analysis::BlockDesign>& blocks) {
  std::map<std::string, std::string> titles;
  for (const analysis::BlockDesign& block : blocks) {
    titles[block.block] = block_title(study, block.block);
  }
  return titles;
}

/// What questionnaires ask after the experiment and after trials, in the study's first
/// language.
std::map<std::string, std::string> questions_of(const experiments::Study& study) {
  std::map<std::string, std::string> questions;
  const auto add = [&](const auto& items) {
    for (const auto& item : items) {
      const std::string& words = in_language(item.question, study.languages.front());
      if (!words.empty()) questions.emplace(item.name, words);
    }
  };
  experiments::for_each_stage(study.stages, [&](const experiments::Stage& stage) {
    if (const auto* form = std::get_if<experiments::Questionnaire>(&stage.content)) {
      add(form->items);
    } else if (const auto* post = std::get_if<experiments::PostExperiment>(&stage.content)) {
      add(post->items);
    } else if (const auto* block = std::get_if<experiments::Block>(&stage.content)) {
      add(block->questions);
    }
  });
  return questions;
}

/// Replaces the program's names in a sentence by words, such as "stroke_width_m" by "stroke
/// width [m]", and blocks' names by their titles. A name that could be an ordinary word, such
/// as "production", stays as it is.
std::string told_in_words(const ResultsSource& source, const std::string& sentence) {
  const auto is_of_a_name = [](char letter) {
    return letter == '_' || std::isalnum(static_cast<unsigned char>(letter)) != 0;
  };
  std::string words;
  for (std::size_t at = 0; at < sentence.size();) {
    std::size_t end = at;
    while (end < sentence.size() && is_of_a_name(sentence[end])) ++end;
    if (end == at) {
      words += sentence[at++];
      continue;
    }
    const std::string name = sentence.substr(at, end - at);
    const bool has_part =
        end + 1 < sentence.size() && sentence[end] == '.' && is_of_a_name(sentence[end + 1]);
    const auto block = source.titles.find(name);
    if (name.find('_') == std::string::npos) {
      words += name;
    } else if (block != source.titles.end()) {
      // "group_d.weber_fraction" becomes "Group D: weber fraction".
      words += short_title(block->second) + (has_part ? ": " : "");
      if (has_part) ++end;
    } else {
      // A part of a file's name or path stays as it is.
      const bool is_of_a_file = has_part || (at > 0 && sentence[at - 1] == '/');
      words += is_of_a_file ? name : name_words(name, /*as_title=*/false);
    }
    at = end;
  }
  return words;
}

/// Puts everything that people read into words without the program's names.
void tell_in_words(const ResultsSource& source, ResultsModel& model) {
  const auto tell = [&source](std::string& told) { told = told_in_words(source, told); };
  const auto tell_chart = [&tell](analysis::Chart& chart) {
    tell(chart.detail);
    tell(chart.reason);
    tell(chart.caution);
    for (analysis::ChartSeries& series : chart.series) tell(series.legend);
  };
  for (analysis::ChartSet& set : model.charts) {
    tell(set.heading);
    if (set.everybody) tell_chart(*set.everybody);
    for (analysis::Chart& chart : set.participants) tell_chart(chart);
  }
  for (ComparisonLine& line : model.comparisons) {
    tell(line.name);
    tell(line.detail);
  }
  for (NumberLine& line : model.numbers) {
    tell(line.section);
    tell(line.label);
    tell(line.meaning);
    tell(line.caution);
    tell(line.published);
  }
  for (QualityChip& chip : model.quality) tell(chip.text);
  for (TableRow& row : model.rows) tell(row.note);
}

}  // namespace

std::string ResultsSource::title(const std::string& block) const {
  const auto found = titles.find(block);
  return found == titles.end() ? block : found->second;
}

std::string ResultsSource::in_titles(std::string sentence) const {
  const auto is_of_a_name = [&sentence](std::size_t at) {
    const auto letter = static_cast<unsigned char>(at < sentence.size() ? sentence[at] : ' ');
    return std::isalnum(letter) != 0 || letter == '_';
  };
  for (const auto& [block, title] : titles) {
    const std::string words = short_title(title);
    for (std::size_t at = sentence.find(block); at != std::string::npos;
         at = sentence.find(block, at)) {
      const bool is_whole =
          (at == 0 || !is_of_a_name(at - 1)) && !is_of_a_name(at + block.size());
      if (is_whole) sentence.replace(at, block.size(), words);
      at += is_whole ? words.size() : block.size();
    }
  }
  return sentence;
}

const analysis::ResultsSection* ResultsSource::section(const std::string& name) const {
  for (const analysis::ResultsSection& one : results.sections) {
    if (one.name == name) return &one;
  }
  return nullptr;
}

const analysis::ParticipantEstimate* ResultsSource::own(const std::string& section_name,
                                                        const std::string& participant,
                                                        const std::string& estimate) const {
  const analysis::ResultsSection* found = section(section_name);
  if (found == nullptr) return nullptr;
  for (const analysis::ParticipantEstimate& one : found->participants) {
    if (one.participant == participant && one.name == estimate) return &one;
  }
  return nullptr;
}

ResultsModel results_model(const std::filesystem::path& folder, WorkControl& control) {
  const core::StudyStore store(folder, core::StudyStore::Mode::kReadOnly);
  require_results_open(store);
  const analysis::StudyData data = analysis::load_study(store);
  const experiments::Study study = study_in(store);
  control.progress(0.1);
  control.stop_if_cancelled();
  analysis::StudyResults results = results_of_data(data);
  results.preregistration = preregistered_study(store, data);
  control.progress(0.8);
  control.stop_if_cancelled();
  const ResultsSource source{data, results, titles_of(study, data.blocks), questions_of(study)};
  analysis::StudyTitles chart_titles = analysis::titles_of(study);
  chart_titles.stages.insert(source.titles.begin(), source.titles.end());
  ResultsModel model{.study = results.study,
                     .title = title_of(study),
                     .simulated = results.simulated,
                     .citation = results.citation,
                     .num_participants = results.num_participants,
                     .charts = analysis::charts_of({data, results, chart_titles}),
                     .boxes = boxes_of(source)};
  add_table(source, model);
  add_numbers(source, model);
  control.progress(0.9);
  control.stop_if_cancelled();
  Quality(store, study).describe(source, model.quality);
  tell_in_words(source, model);
  control.progress(1.0);
  return model;
}

}  // namespace jnd::app
