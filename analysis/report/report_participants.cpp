#include <algorithm>
#include <map>
#include <set>

#include "analysis/report/answer_words.h"
#include "analysis/report/report_methods.h"
#include "analysis/results/number_words.h"
#include "analysis/statistics/summary.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

// Units of numbers that people often give; the others are international.
[[maybe_unused]] constexpr const char* kUnits[] = {said_later("years"), said_later("hours")};

/// "3, –, 5": of an item whose stage came three times.
std::string all_answers_words(const std::vector<std::string>& answers,
                              const QuestionnaireItem& item) {
  std::string words;
  for (const std::string& answer : answers) {
    words += (words.empty() ? "" : ", ") + (answer.empty() ? "–" : answer_words(answer, item));
  }
  return words.empty() ? "–" : words;
}

/// "Age 27.3 ± 4.1 years (21 to 34, n = 13)", "gender: female 6, male 7".
std::string described(const StudyData& data, const QuestionnaireItem& item) {
  std::vector<double> numbers;
  std::map<std::string, int> counts;
  for (const ParticipantData& participant : data.participants) {
    const std::vector<std::string> answers = answers_by_time(participant.answers, item);
    // What changes within a session is no trait of a person; the results tell each time.
    if (answers.size() > 1) return "";
    if (answers.empty() || answers.front().empty()) continue;
    if (const auto number = number_of(answers.front())) numbers.push_back(*number);
    ++counts[answers.front()];
  }
  if (counts.empty()) return "";
  std::string words = item_words(item);
  if (item.kind != "number") {
    std::string list;
    for (const auto& [answer, count] : counts) {
      list += (list.empty() ? " " : ", ") + answer_words(answer, item) + " " +
              std::to_string(count);
    }
    return words + (words.ends_with('?') ? "" : ":") + list;
  }
  if (numbers.empty()) return "";
  const Summary summary = summary_of(numbers);
  const auto [least, most] = std::minmax_element(numbers.begin(), numbers.end());
  words += " " + number_words(summary.mean, 2);
  if (summary.standard_deviation) words += " ± " + number_words(summary.standard_deviation, 2);
  words += item.unit.empty() ? "" : " " + said_of(item.unit);
  return said("{} ({} to {}, n = {})", words, shortest_words(*least), shortest_words(*most),
              std::to_string(summary.num_values));
}

std::vector<QuestionnaireItem> described_items(const StudyData& data) {
  std::vector<QuestionnaireItem> items;
  for (const QuestionnaireItem& item : data.items) {
    if (item.kind == "number" || item.kind == "choice" || item.kind == "yes_no") {
      items.push_back(item);
    }
  }
  return items;
}

std::string dash_if_none(std::int64_t count) {
  return count == 0 ? "–" : std::to_string(count);
}

/// Removes the columns with these titles.
void drop_columns(HtmlTable& table, const std::set<std::string>& titles) {
  for (std::size_t i = table.columns.size(); i-- > 0;) {
    if (!titles.contains(table.columns[i].title)) continue;
    const auto at = static_cast<std::ptrdiff_t>(i);
    table.columns.erase(table.columns.begin() + at);
    for (std::vector<std::string>& row : table.rows) row.erase(row.begin() + at);
  }
}

bool any_trials(const ChapterSource& source) {
  return std::ranges::any_of(source.quality,
                             [](const SessionQuality& one) { return one.num_drawn > 0; });
}

HtmlTable quality_table(const ChapterSource& source) {
  HtmlTable table{.caption = said("Data of every session: trials as drawn, answers that stand "
                                  "and count, and what happened to the others"),
                  .columns = {{said("Participant")},
                              {said("Ended")},
                              {said("Drawn"), true},
                              {said("Answered"), true},
                              {said("Missing"), true},
                              {said("Set aside"), true},
                              {said("Undone"), true},
                              {said("Run again"), true},
                              {said("Resumed"), true},
                              {said("Pauses"), true},
                              {said("Faults"), true},
                              {said("Duration"), true}}};
  for (const SessionQuality& one : source.quality) {
    const char* const ended = one.completed             ? said("completed")
                              : one.ended_early.empty() ? said("open")
                                                        : said("early");
    table.rows.push_back({one.session.participant, ended, std::to_string(one.num_drawn),
                          std::to_string(one.num_answered), dash_if_none(one.num_missing()),
                          dash_if_none(one.num_excluded),
                          dash_if_none(one.num_undone + one.num_corrected),
                          dash_if_none(one.num_discarded), dash_if_none(one.num_resumed),
                          dash_if_none(one.num_paused), dash_if_none(one.num_faults),
                          duration_words(one.duration_s)});
  }
  table.notes = {
      said("Undone: answers taken back or corrected. Run again: attempts without an answer "
           "that were given up, because they were interrupted or invalid.")};
  if (!any_trials(source)) {
    table.caption = said("Every session");
    drop_columns(table, {said("Drawn"), said("Answered"), said("Missing"), said("Set aside"),
                         said("Undone"), said("Run again")});
    table.notes.clear();
  }
  return table;
}

HtmlTable movement_table(const ChapterSource& source) {
  HtmlTable table{.caption = said("Presentations and recordings of every session"),
                  .columns = {{said("Participant")},
                              {said("Presentations"), true},
                              {said("Force limited"), true},
                              {said("No whole stroke"), true},
                              {said("Media explored"), true},
                              {said("Recording")},
                              {said("Lost samples"), true},
                              {said("Lost contact"), true}}};
  for (const SessionQuality& one : source.quality) {
    std::string recording =
        one.session.recorded ? said("missing") : said("summaries of strokes");
    if (one.missing_ticks)
      recording = *one.missing_ticks == 0 ? said("whole") : said("with gaps");
    std::int64_t lost_contact = 0;
    std::int64_t num_explored = 0;
    bool analysed = false;
    for (const ParticipantMovement& person : source.report.movement.participants) {
      if (person.participant != one.session.participant || !person.reason.empty()) continue;
      for (const PresentationMovement& presentation : person.presentations) {
        if (presentation.session != one.session.session) continue;
        analysed = true;
        num_explored += presentation.block.empty() ? 1 : 0;
        lost_contact += presentation.marks.lost_contact_ticks > 0 ? 1 : 0;
      }
    }
    table.rows.push_back({one.session.participant, std::to_string(one.num_presentations),
                          dash_if_none(one.num_limited), dash_if_none(one.num_strokeless),
                          analysed ? std::to_string(num_explored) : "–", recording,
                          one.missing_ticks ? std::to_string(*one.missing_ticks) : "–",
                          analysed ? std::to_string(lost_contact) : "–"});
  }
  table.notes = {
      said("Force limited, no whole stroke, lost contact: counts of presentations. Lost "
           "samples are not filled in anywhere.")};
  const bool any_presented = std::ranges::any_of(
      source.quality, [](const SessionQuality& one) { return one.num_presentations > 0; });
  if (!any_presented) {
    table.caption = said("Recordings of every session");
    drop_columns(table,
                 {said("Presentations"), said("Force limited"), said("No whole stroke")});
    table.notes = {
        said("This study presents nothing in trials. Lost contact: media during which a point "
             "lost the hand. Lost samples are not filled in anywhere.")};
  }
  return table;
}

/// A table that shows whether losses depend on what was presented.
HtmlTable losses_table(const ChapterSource& source) {
  HtmlTable table{
      .caption = said("Trials that were lost or did not go as meant, by stimulus level"),
      .columns = {{said("Block")},
                  {said("Level"), true},
                  {said("Drawn"), true},
                  {said("Answered"), true},
                  {said("Set aside"), true},
                  {said("Repeated"), true},
                  {said("Discarded"), true},
                  {said("Faulted"), true},
                  {said("Force limited"), true},
                  {said("No whole stroke"), true}}};
  for (const LevelLoss& one : source.report.results.losses) {
    if (!one.is_any()) continue;
    table.rows.push_back({one.block,
                          one.is_catch ? said("catch trials")
                          : one.level  ? shortest_words(*one.level)
                                       : said("all"),
                          std::to_string(one.num_drawn), std::to_string(one.num_answered),
                          dash_if_none(one.num_set_aside), dash_if_none(one.num_repeated),
                          dash_if_none(one.num_discarded), dash_if_none(one.num_faulted),
                          dash_if_none(one.num_limited), dash_if_none(one.num_strokeless)});
  }
  table.notes = {
      said("Levels at which nothing of it happened are left out. Repeated: run again, for an "
           "answer was taken back or an attempt given up (discarded). Force limited: in any "
           "presentation of a stimulus. No whole stroke: test or reference was never felt over "
           "one. Where more than 2 % of a block’s answers are affected, its primary values "
           "stand without them, too, as NAME.without_affected_trials.")};
  return table;
}

HtmlTable timing_table(const ChapterSource& source) {
  HtmlTable table{.caption = said("Punctuality of the haptic loop"),
                  .columns = {{said("Participant")},
                              {said("Ticks"), true},
                              {said("Missed"), true},
                              {said("Samples dropped"), true},
                              {said("Lateness p99 [µs]"), true},
                              {said("Largest [µs]"), true}}};
  for (const SessionQuality& one : source.quality) {
    if (!one.timing) continue;
    const SessionTiming& timing = *one.timing;
    const auto p99_us =
        timing.lateness_p99_s ? std::optional(1e6 * *timing.lateness_p99_s) : std::nullopt;
    table.rows.push_back({one.session.participant, std::to_string(timing.num_ticks),
                          std::to_string(timing.missed_ticks),
                          std::to_string(timing.num_dropped_samples), number_words(p99_us, 1),
                          number_words(1e6 * timing.max_lateness_s, 1)});
  }
  return table;
}

std::vector<std::string> remarks_of(const ChapterSource& source) {
  constexpr std::size_t kMost = 200;
  std::vector<std::string> remarks;
  for (const SessionQuality& one : source.quality) {
    for (const std::string& remark : one.remarks) {
      if (remarks.size() == kMost) {
        remarks.emplace_back(said("… and more; events.csv of jnd export has them all"));
        return remarks;
      }
      remarks.push_back(one.session.participant + ": " + remark);
    }
  }
  return remarks;
}

}  // namespace

void write_participants_in_short(HtmlText& html, const ChapterSource& source) {
  html.heading(2, said("Participants"));
  const StudyData& data = source.report.data;
  std::string text = counted_words(std::ssize(data.participants), "participant");
  if (data.simulated) text += said(", all SIMULATED");
  text += ".";
  for (const QuestionnaireItem& item : described_items(data)) {
    const std::string words = described(data, item);
    if (!words.empty()) text += " " + words + ".";
  }
  const auto num_withdrawn = std::ssize(source.report.store.withdrawals());
  if (num_withdrawn > 0) {
    text += said(" {} of participants who withdrew left no data.",
                 counted_words(num_withdrawn, "session"));
  }
  const auto num_pilots =
      std::ssize(source.report.store.sessions()) - std::ssize(source.sessions);
  if (num_pilots > 0) {
    text += said(" {} left out.", counted_words(num_pilots, said("pilot session")));
  }
  html.paragraph(text);
}

void write_participants(HtmlText& html, const ChapterSource& source) {
  write_participants_in_short(html, source);
  const StudyData& data = source.report.data;
  const std::vector<QuestionnaireItem> items = described_items(data);
  HtmlTable table{.caption = said("Participants"), .columns = {{said("Participant")}}};
  for (const QuestionnaireItem& item : items) {
    const std::string title = item_words(item);
    table.columns.push_back(
        {item.unit.empty() ? title : title + " [" + said_of(item.unit) + "]"});
  }
  table.columns.push_back({said("Cell")});
  for (const ParticipantData& participant : data.participants) {
    std::vector<std::string> row = {participant.participant};
    for (const QuestionnaireItem& item : items) {
      row.push_back(all_answers_words(answers_by_time(participant.answers, item), item));
    }
    row.push_back(cell_words(participant.cells));
    table.rows.push_back(std::move(row));
  }
  html.table(table);
}

void write_data_quality_in_short(HtmlText& html, const ChapterSource& source) {
  html.heading(2, said("Data quality"));
  std::int64_t drawn = 0;
  std::int64_t answered = 0;
  std::int64_t excluded = 0;
  std::int64_t open = 0;
  for (const SessionQuality& one : source.quality) {
    drawn += one.num_drawn;
    answered += one.num_answered;
    excluded += one.num_excluded;
    open += one.completed ? 0 : 1;
  }
  std::string text =
      drawn == 0 ? said("This study has no trials: nothing is asked that could be missing. ")
                 : said(
                       "{} of {} were answered and count; {} were answered and set aside, {} "
                       "have no answer. ",
                       std::to_string(answered), counted_words(drawn, "drawn trial"),
                       std::to_string(excluded), std::to_string(drawn - answered - excluded));
  text += open == 0 ? said("Every session was completed.")
                    : said("{} did not come to its end.", counted_words(open, "session"));
  html.paragraph(text);
}

void write_data_quality(HtmlText& html, const ChapterSource& source) {
  write_data_quality_in_short(html, source);
  html.table(quality_table(source));
  html.table(movement_table(source));
  html.table(losses_table(source));
  const HtmlTable timing = timing_table(source);
  if (timing.rows.empty()) {
    html.paragraph(said("There is no punctuality of the loop to report: the ticks of these "
                        "sessions had no due time."),
                   "note");
  }
  html.table(timing);
  const std::vector<std::string> remarks = remarks_of(source);
  if (!remarks.empty()) html.paragraph(said("Remarks in the logs:"));
  html.list(remarks);
}

}  // namespace jnd::analysis
