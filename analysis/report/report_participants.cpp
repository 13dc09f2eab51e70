#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <set>

#include "analysis/report/report_methods.h"
#include "analysis/results/number_words.h"
#include "analysis/statistics/summary.h"

namespace jnd::analysis {
namespace {

std::optional<double> number_of(const std::string& text) {
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, value);
  if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
  return value;
}

const core::AnswerRow* answer_of(const ParticipantData& participant,
                                 const QuestionnaireItem& item) {
  const core::AnswerRow* found = nullptr;
  for (const core::AnswerRow& answer : participant.answers) {
    if (answer.stage == item.stage && answer.item == item.name) found = &answer;
  }
  return found;
}

std::string in_words(std::string name, const std::string& unit) {
  if (!unit.empty() && name.ends_with("_" + unit)) name.resize(name.size() - unit.size() - 1);
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

/// "not said" of "not_said", 26 of "26.00": as a person would write it.
std::string answer_words(const std::string& answer) {
  if (const auto number = number_of(answer)) return shortest_words(*number);
  std::string words = answer;
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

/// "Age 27.3 ± 4.1 years (21 to 34, n = 13)", "gender: female 6, male 7".
std::string described(const StudyData& data, const QuestionnaireItem& item) {
  std::vector<double> numbers;
  std::map<std::string, int> counts;
  for (const ParticipantData& participant : data.participants) {
    const core::AnswerRow* const answer = answer_of(participant, item);
    if (answer == nullptr || answer->answer.empty()) continue;
    if (const auto number = number_of(answer->answer)) numbers.push_back(*number);
    ++counts[answer->answer];
  }
  if (counts.empty()) return "";
  std::string words = in_words(item.name, item.unit);
  if (item.kind != "number") {
    std::string list;
    for (const auto& [answer, count] : counts) {
      list += (list.empty() ? " " : ", ") + answer_words(answer) + " " + std::to_string(count);
    }
    return words + ":" + list;
  }
  if (numbers.empty()) return "";
  const Summary summary = summary_of(numbers);
  const auto [least, most] = std::minmax_element(numbers.begin(), numbers.end());
  words += " " + number_words(summary.mean, 2);
  if (summary.standard_deviation) words += " ± " + number_words(summary.standard_deviation, 2);
  words += item.unit.empty() ? "" : " " + item.unit;
  return words + " (" + shortest_words(*least) + " to " + shortest_words(*most) +
         ", n = " + std::to_string(summary.num_values) + ")";
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

/// Takes the columns away whose titles these are.
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
  HtmlTable table{
      .caption =
          "Data of every session: trials as drawn, answers that stand and count, and "
          "what happened to the others",
      .columns = {{"Participant"},
                  {"Ended"},
                  {"Drawn", true},
                  {"Answered", true},
                  {"Missing", true},
                  {"Set aside", true},
                  {"Undone", true},
                  {"Run again", true},
                  {"Resumed", true},
                  {"Pauses", true},
                  {"Faults", true},
                  {"Duration", true}}};
  for (const SessionQuality& one : source.quality) {
    const char* const ended = one.completed             ? "completed"
                              : one.ended_early.empty() ? "open"
                                                        : "early";
    table.rows.push_back({one.session.participant, ended, std::to_string(one.num_drawn),
                          std::to_string(one.num_answered), dash_if_none(one.num_missing()),
                          dash_if_none(one.num_excluded),
                          dash_if_none(one.num_undone + one.num_corrected),
                          dash_if_none(one.num_discarded), dash_if_none(one.num_resumed),
                          dash_if_none(one.num_paused), dash_if_none(one.num_faults),
                          duration_words(one.duration_s)});
  }
  table.notes = {
      "Undone: answers taken back or corrected. Run again: attempts without an "
      "answer that were given up, because they were interrupted or invalid."};
  if (!any_trials(source)) {
    table.caption = "Every session";
    drop_columns(table, {"Drawn", "Answered", "Missing", "Set aside", "Undone", "Run again"});
    table.notes.clear();
  }
  return table;
}

HtmlTable movement_table(const ChapterSource& source) {
  HtmlTable table{.caption = "Presentations and recordings of every session",
                  .columns = {{"Participant"},
                              {"Presentations", true},
                              {"Force limited", true},
                              {"No whole stroke", true},
                              {"Media explored", true},
                              {"Recording"},
                              {"Lost samples", true},
                              {"Lost contact", true}}};
  for (const SessionQuality& one : source.quality) {
    std::string recording = one.session.recorded ? "missing" : "summaries of strokes";
    if (one.missing_ticks) recording = *one.missing_ticks == 0 ? "whole" : "with gaps";
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
      "Force limited, no whole stroke, lost contact: counts of presentations. Lost "
      "samples are not filled in anywhere."};
  const bool any_presented = std::ranges::any_of(
      source.quality, [](const SessionQuality& one) { return one.num_presentations > 0; });
  if (!any_presented) {
    table.caption = "Recordings of every session";
    drop_columns(table, {"Presentations", "Force limited", "No whole stroke"});
    table.notes = {
        "This study presents nothing in trials. Lost contact: media during which a point lost "
        "the hand. Lost samples are not filled in anywhere."};
  }
  return table;
}

/// Whether loss depends on what was presented.
HtmlTable losses_table(const ChapterSource& source) {
  HtmlTable table{.caption = "Trials that were lost or did not go as meant, by stimulus level",
                  .columns = {{"Block"},
                              {"Level", true},
                              {"Drawn", true},
                              {"Answered", true},
                              {"Set aside", true},
                              {"Repeated", true},
                              {"Discarded", true},
                              {"Faulted", true},
                              {"Force limited", true},
                              {"No whole stroke", true}}};
  for (const LevelLoss& one : source.report.results.losses) {
    if (!one.is_any()) continue;
    table.rows.push_back({one.block,
                          one.is_catch ? "catch trials"
                          : one.level  ? shortest_words(*one.level)
                                       : "all",
                          std::to_string(one.num_drawn), std::to_string(one.num_answered),
                          dash_if_none(one.num_set_aside), dash_if_none(one.num_repeated),
                          dash_if_none(one.num_discarded), dash_if_none(one.num_faulted),
                          dash_if_none(one.num_limited), dash_if_none(one.num_strokeless)});
  }
  table.notes = {
      "Levels at which nothing of it happened are left out. Repeated: run again, for an answer "
      "was taken back or an attempt given up (discarded). Force limited: in any presentation "
      "of "
      "a stimulus. No whole stroke: test or reference was never felt over one. Where more than "
      "2 % of a block’s answers are affected, its primary values stand without them, too, as "
      "NAME.without_affected_trials."};
  return table;
}

HtmlTable timing_table(const ChapterSource& source) {
  HtmlTable table{.caption = "Punctuality of the haptic loop",
                  .columns = {{"Participant"},
                              {"Ticks", true},
                              {"Missed", true},
                              {"Samples dropped", true},
                              {"Lateness p99 [µs]", true},
                              {"Largest [µs]", true}}};
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
        remarks.emplace_back("… and more; events.csv of jnd export has them all");
        return remarks;
      }
      remarks.push_back(one.session.participant + ": " + remark);
    }
  }
  return remarks;
}

}  // namespace

void write_participants_in_short(HtmlText& html, const ChapterSource& source) {
  html.heading(2, "Participants");
  const StudyData& data = source.report.data;
  std::string text = counted_words(std::ssize(data.participants), "participant");
  if (data.simulated) text += ", all SIMULATED";
  text += ".";
  for (const QuestionnaireItem& item : described_items(data)) {
    const std::string words = described(data, item);
    if (!words.empty()) text += " " + words + ".";
  }
  const auto num_withdrawn = std::ssize(source.report.store.withdrawals());
  if (num_withdrawn > 0) {
    text += " " + counted_words(num_withdrawn, "session") +
            " of participants who withdrew left no data.";
  }
  const auto num_pilots =
      std::ssize(source.report.store.sessions()) - std::ssize(source.sessions);
  if (num_pilots > 0) {
    text += " " + counted_words(num_pilots, "pilot session") + " left out.";
  }
  html.paragraph(text);
}

void write_participants(HtmlText& html, const ChapterSource& source) {
  write_participants_in_short(html, source);
  const StudyData& data = source.report.data;
  const std::vector<QuestionnaireItem> items = described_items(data);
  HtmlTable table{.caption = "Participants", .columns = {{"Participant"}}};
  for (const QuestionnaireItem& item : items) {
    const std::string title = in_words(item.name, item.unit);
    table.columns.push_back({item.unit.empty() ? title : title + " [" + item.unit + "]"});
  }
  table.columns.push_back({"Cell"});
  for (const ParticipantData& participant : data.participants) {
    std::vector<std::string> row = {participant.participant};
    for (const QuestionnaireItem& item : items) {
      const core::AnswerRow* const answer = answer_of(participant, item);
      row.push_back(answer == nullptr || answer->answer.empty() ? "–"
                                                                : answer_words(answer->answer));
    }
    row.push_back(cell_words(participant.cells));
    table.rows.push_back(std::move(row));
  }
  html.table(table);
}

void write_data_quality_in_short(HtmlText& html, const ChapterSource& source) {
  html.heading(2, "Data quality");
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
      drawn == 0 ? std::string(
                       "This study has no trials: nothing is asked that could be "
                       "missing. ")
                 : std::to_string(answered) + " of " + counted_words(drawn, "drawn trial") +
                       " were answered and count; " + std::to_string(excluded) +
                       " were answered and set aside, " +
                       std::to_string(drawn - answered - excluded) + " have no answer. ";
  text += open == 0 ? "Every session was completed."
                    : counted_words(open, "session") + " did not come to its end.";
  html.paragraph(text);
}

void write_data_quality(HtmlText& html, const ChapterSource& source) {
  write_data_quality_in_short(html, source);
  html.table(quality_table(source));
  html.table(movement_table(source));
  html.table(losses_table(source));
  const HtmlTable timing = timing_table(source);
  if (timing.rows.empty()) {
    html.paragraph(
        "There is no punctuality of the loop to report: the ticks of these sessions had no due "
        "time.",
        "note");
  }
  html.table(timing);
  const std::vector<std::string> remarks = remarks_of(source);
  if (!remarks.empty()) html.paragraph("Remarks in the logs:");
  html.list(remarks);
}

}  // namespace jnd::analysis
