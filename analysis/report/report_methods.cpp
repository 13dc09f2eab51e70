#include "analysis/report/report_methods.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "analysis/data/stored_studies.h"
#include "analysis/report/method_words.h"
#include "analysis/report/report_sound.h"
#include "analysis/results/number_words.h"
#include "analysis/results/threshold_results.h"
#include "analysis/statistics/summary.h"
#include "analysis/words/said.h"
#include "core/storage/sha256.h"
#include "experiments/study/media.h"
#include "experiments/study/stage_walk.h"

namespace jnd::analysis {
namespace {

std::string joined(const std::set<std::string>& words, const std::string& between = ", ") {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : between) + word;
  return all;
}

std::string joined(const std::set<double>& numbers, const std::string& unit) {
  std::string all;
  for (const double number : numbers) all += (all.empty() ? "" : ", ") + shortest_words(number);
  return unit.empty() ? all : all + " " + unit;
}

std::string reference_words(const BlockDesign& block, const std::set<double>& references) {
  if (block.written.standard_medium.empty()) {
    return said("reference {}", joined(references, experiments::quantity_unit(block.quantity)));
  }
  const std::string quantity = block.standard_quantity();
  return said("standard {} {} of the medium “{}”{}",
              said_of(experiments::quantity_words(quantity)),
              joined(references, experiments::quantity_unit(quantity)),
              said_of(in_words(block.written.standard_medium)),
              (block.counts_in_standard()
                   ? said(", which counts as {}",
                          shortest_words(block.written.settings.number("modulus_value")))
                   : ""));
}

/// How many trials people had. If the answers decide it, the words use the counts in the data.
std::string num_trials_words(const StudyData& data, const BlockDesign& block) {
  if (!block.is_adaptive())
    return said("{} a participant", counted_words(block.num_trials, "trial"));
  const auto count = [&](const std::vector<core::TrialRow>& trials) {
    return std::ranges::count(trials, block.block, &core::TrialRow::block);
  };
  std::vector<double> counts;
  for (const ParticipantData& one : data.participants) {
    const auto num = count(one.trials) + count(one.catch_trials) + count(one.excluded_trials);
    if (num > 0) counts.push_back(static_cast<double>(num));
  }
  if (counts.empty()) return said("no trials");
  const auto [least, most] = std::ranges::minmax(counts);
  if (least == most) {
    return said("{} a participant", counted_words(static_cast<std::int64_t>(least), "trial"));
  }
  return said("trials a participant as the answers led to: mean {}, from {} to {}",
              number_words(summary_of(counts).mean, 1), shortest_words(least),
              shortest_words(most));
}

std::string practice_words(const experiments::Block& block) {
  const experiments::Practice& practice = *block.practice;
  const std::string unit = experiments::quantity_unit(block.quantity);
  std::string words = said("practice, no data; {}; {}", procedure_words(block),
                           said_of(experiments::quantity_words(block.quantity)));
  if (!block.intensities.empty()) {
    words += said("; levels {}",
                  joined(std::set(block.intensities.begin(), block.intensities.end()), unit));
  }
  if (block.reference_intensity) {
    words += said("; reference {}", joined(std::set{*block.reference_intensity}, unit));
  }
  words += block.feedback
               ? said("; participants were told after every answer whether it was right")
               : said("; without feedback");
  return said("{}; until {} % of the last {} were right, at most {}.", words,
              shortest_words(std::round(1000.0 * practice.min_correct_ratio) / 10.0),
              counted_words(practice.num_trials_judged, "answer"),
              counted_words(practice.max_trials, "trial"));
}

/// What limits a trial: its stimuli, going back to them, and its answer.
std::string answering_words(const experiments::Block& block) {
  const auto seconds = [](double duration_s) { return shortest_words(duration_s) + " s"; };
  std::string words;
  if (block.min_stimulus_s > 0.0 && block.max_stimulus_s == block.min_stimulus_s) {
    words += said("; each stimulus was felt for {}", seconds(block.min_stimulus_s));
  } else {
    if (block.min_stimulus_s > 0.0)
      words += said("; each stimulus was felt for {} at least", seconds(block.min_stimulus_s));
    if (block.max_stimulus_s)
      words += said("; each stimulus ended after {} at most", seconds(*block.max_stimulus_s));
  }
  if (block.max_returns) {
    words += *block.max_returns == 0 ? said("; nobody went back to a stimulus")
                                     : said("; at most {} to stimuli in a trial",
                                            counted_words(*block.max_returns, "return"));
  }
  if (block.answer_deadline_s) {
    words += said(
        "; a trial without an answer {} after the start of the stimulus with which all had "
        "been felt was run again",
        seconds(*block.answer_deadline_s));
  }
  if (block.cannot_tell) words += said("; “cannot tell” was an answer, too");
  return words;
}

/// What a block presented, from its answered trials.
std::string block_words(const StudyData& data, const BlockDesign& block) {
  std::set<double> intensities;
  std::set<double> references;
  std::set<double> starts;
  std::set<double> targets;
  std::set<std::string> media;
  std::int64_t repetitions = 0;
  for (const ParticipantData& participant : data.participants) {
    for (const core::TrialRow& trial : participant.trials_in(block.block)) {
      const bool adjusts = trial.starting_intensity.has_value();
      if (trial.intensity && !adjusts) intensities.insert(*trial.intensity);
      if (trial.reference_intensity) references.insert(*trial.reference_intensity);
      if (trial.starting_intensity) starts.insert(*trial.starting_intensity);
      if (trial.target_percent) targets.insert(*trial.target_percent);
      if (!trial.medium.empty()) media.insert(said_of(in_words(trial.medium)));
      repetitions = std::max(repetitions, trial.repetition);
    }
  }
  const std::string unit = experiments::quantity_unit(block.quantity);
  std::string words = procedure_words(block.written);
  if (!block.quantity.empty())
    words += "; " + said_of(experiments::quantity_words(block.quantity));
  if (!media.empty()) words += said(" of the medium “{}”", joined(media));
  constexpr std::size_t kMostListed = 20;
  const bool are_listed = block.has_fixed_levels() && intensities.size() <= kMostListed;
  if (!intensities.empty() && !are_listed) {
    words += said("; {} from {} to {}{}", counted_words(std::ssize(intensities), "level"),
                  number_words(*intensities.begin()), number_words(*intensities.rbegin()),
                  (unit.empty() ? "" : " " + unit));
  } else if (!intensities.empty()) {
    words += said("; levels {}", joined(intensities, unit));
  }
  if (!references.empty()) words += "; " + reference_words(block, references);
  if (block.counts_in_own_numbers()) words += said("; numbers of everybody’s own choice");
  if (!targets.empty()) words += said("; set to feel like {}", joined(targets, "%"));
  if (!starts.empty()) words += said("; starting from {}", joined(starts, unit));
  if (block.rates()) {
    words += said("; on a scale from 1, “{}”, to {}, “{}”",
                  in_spoken_language(block.written.low_label),
                  shortest_words(block.written.settings.number("num_steps", 10.0)),
                  in_spoken_language(block.written.high_label));
  }
  words += answering_words(block.written);
  for (const experiments::QuestionnaireItem& item : block.written.questions) {
    words += said("; after each trial “{}”", in_spoken_language(item.question));
    if (item.kind == "scale") words += said(" on {} steps", std::to_string(item.num_steps));
  }
  words += "; ";
  if (block.has_fixed_levels()) words += counted_words(repetitions, "repetition") + ", ";
  return words + num_trials_words(data, block) + ".";
}

std::string design_words(const ChapterSource& source) {
  const experiments::Study& study = source.report.data.written;
  std::string text = in_spoken_language(study.description);
  if (!text.empty() && !text.ends_with('.')) text += ".";
  // If nothing is asked, there is nothing to blind.
  if (!source.report.data.blocks.empty()) {
    text += said(" Blinding: {}.",
                 (study.blinding == experiments::Blinding::kDouble
                      ? said("double; the levels were unblinded before this report")
                  : study.blinding == experiments::Blinding::kParticipant
                      ? said("single, the participant did not know the levels")
                      : "none"));
  }
  std::map<std::string, int> cells;
  for (const core::SessionRow& session : source.sessions) ++cells[session.cells];
  // Squares of many conditions have one cell for every row of every stratum.
  constexpr std::size_t kMostToldSingly = 6;
  if (cells.size() > kMostToldSingly) {
    int fewest = static_cast<int>(source.sessions.size()), most = 0;
    for (const auto& [cell, count] : cells) {
      fewest = std::min(fewest, count);
      most = std::max(most, count);
    }
    text += said(" Counterbalancing: {} cells of {}{}{}; everybody’s is in the supplement.",
                 std::to_string(cells.size()), std::to_string(fewest),
                 (most > fewest ? said(" to {} participants", std::to_string(most)) : ""),
                 (most > fewest ? ""
                  : most == 1   ? said(" participant")
                                : said(" participants")));
  } else if (cells.size() > 1) {
    text += said(" Counterbalancing, with the number of participants in each cell: ");
    bool first = true;
    for (const auto& [cell, count] : cells) {
      text += (first ? "" : " | ") + cell_words(cell) + " (" + std::to_string(count) + ")";
      first = false;
    }
    text += ".";
  }
  return text;
}

std::string apparatus_words(const ChapterSource& source) {
  std::set<std::string> devices;
  std::set<double> rates;
  std::set<std::string> realtime;
  for (const core::SessionRow& session : source.sessions) {
    devices.insert(session.device);
    rates.insert(session.rate_hz);
    if (!session.simulated && !session.realtime.empty()) realtime.insert(session.realtime);
  }
  std::string text =
      said("Device: {}; haptic loop at {}", joined(devices), joined(rates, "Hz"));
  if (!realtime.empty()) text += said("; the loop was given: {}", joined(realtime, "; "));
  text += ".";
  const StudyData& data = source.report.data;
  if (data.simulated) {
    text += said(
        " Participants and apparatus are SIMULATED by the laboratory “{}”{} with SHA-256 {}; "
        "nothing here was felt by a person.",
        data.laboratory,
        (source.report.results.laboratory_changed ? said(", changed from the shipped one,")
                                                  : ""),
        core::sha256(data.laboratory_text));
  }
  return text;
}

/// One sentence for each group of blocks whose trials were mixed; "" if there is none.
std::string interleaved_words(const ChapterSource& source) {
  struct Group {
    experiments::Interleaving its;
    std::vector<std::string> titles;
  };
  std::vector<Group> groups;
  for_each_stage(source.report.data.written.stages, [&](const experiments::Stage& stage) {
    if (!stage.interleaving) return;
    if (groups.empty() || !(groups.back().its == *stage.interleaving)) {
      groups.push_back({.its = *stage.interleaving, .titles = {}});
    }
    groups.back().titles.push_back("“" + source.titles.title_of(stage.name) + "”");
  });
  std::string text;
  for (const Group& group : groups) {
    text += text.empty() ? said("Trials of ") : said(" Trials of ");
    for (std::size_t i = 0; i < group.titles.size(); ++i) {
      text += (i == 0                         ? ""
               : i + 1 == group.titles.size() ? said(" and ")
                                              : ", ") +
              group.titles[i];
    }
    text += group.its.turns == experiments::Turns::kRandom
                ? said(
                      " were interleaved: the next trial was drawn from all that were left, "
                      "whatever their block.")
                : said(
                      " were interleaved: in every round each block that had trials left came "
                      "once, in an order drawn anew.");
  }
  return text;
}

}  // namespace

void write_methods(HtmlText& html, const ChapterSource& source) {
  html.heading(2, said("Methods"));
  html.paragraph_about(said("Study"), design_words(source));
  std::vector<std::string> blocks;
  for_each_stage(source.report.data.written.stages, [&](const experiments::Stage& stage) {
    const auto* block = std::get_if<experiments::Block>(&stage.content);
    if (block == nullptr || !block->practice) return;
    blocks.push_back(source.titles.title_of(stage.name) + ": " + practice_words(*block));
  });
  for (const BlockDesign& block : source.report.data.blocks) {
    blocks.push_back(source.titles.title_of(block.block) + ": " +
                     block_words(source.report.data, block));
  }
  html.list(blocks);
  if (const std::string mixed = interleaved_words(source); !mixed.empty()) {
    html.paragraph_about(said("Interleaved blocks"), mixed);
  }
  html.paragraph_about(said("Apparatus"), apparatus_words(source));
  if (const std::string sound = sound_words(source); !sound.empty()) {
    html.paragraph_about(said("Sound"), sound);
  }
  for (const auto& [topic, text] : method_words(source.report).topics) {
    html.paragraph_about(topic, text);
  }
  const std::string& citation = source.report.data.written.citation;
  if (!citation.empty()) html.paragraph_about(said("After"), citation);
}

void write_references(HtmlText& html, const ChapterSource& source) {
  const std::vector<std::string> references = method_words(source.report).references;
  if (references.empty()) return;
  html.heading(2, said("References"));
  html.list(references);
}

void write_provenance(HtmlText& html, const ChapterSource& source) {
  html.heading(2, said("Provenance"));
  const ReportSource& report = source.report;
  std::set<std::string> versions;
  std::set<std::string> protocols;
  for (const core::SessionRow& session : source.sessions) {
    versions.insert(session.program_version);
    protocols.insert(session.protocol_sha256);
  }
  HtmlTable facts{.caption = said("What this report rests on"),
                  .columns = {{said("What")}, {said("Which"), false, true}}};
  for (const std::string& hash : protocols) {
    const core::ProtocolRow protocol = report.store.protocol(hash);
    facts.rows.push_back({said("SHA-256 of the study file {}", protocol.file_name), hash});
  }
  facts.rows.push_back({said("SHA-256 of the data (every event of the sessions below)"),
                        data_sha256(report.store, source.sessions)});
  if (report.data.simulated) {
    facts.rows.push_back({said("SHA-256 of the laboratory {}", report.data.laboratory),
                          core::sha256(report.data.laboratory_text)});
  }
  facts.rows.push_back({said("Recorded with jnd"), joined(versions)});
  facts.rows.push_back({said("Analysed with jnd"), report.program_version});
  html.table(facts);
  HtmlTable sessions{
      .caption = said("Sessions, with the seeds of everything that was drawn in them"),
      .columns = {{said("Session"), true},
                  {said("Participant")},
                  {said("Seed"), true},
                  {said("Began")},
                  {said("Cell")}}};
  for (const core::SessionRow& session : source.sessions) {
    sessions.rows.push_back(
        {std::to_string(session.session), session.participant, std::to_string(session.seed),
         session.simulated ? "simulated" : date_words(session.started_time_ns),
         cell_words(session.cells)});
  }
  html.table(sessions);
}

}  // namespace jnd::analysis
