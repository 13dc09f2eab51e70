#include "app/operator/session_record.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <map>
#include <utility>

#include "app/language/words.h"
#include "app/operator/answer_doubts.h"
#include "app/operator/answer_forms.h"
#include "app/operator/given_answer.h"
#include "app/operator/session_words.h"
#include "app/operator/study_words.h"
#include "app/session/stored_session.h"
#include "core/error.h"
#include "core/storage/flight_record.h"
#include "experiments/order/block_turns.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/procedures/stimulus.h"
#include "experiments/procedures/task.h"
#include "experiments/session/session_state.h"

namespace jnd::app {
namespace {

using namespace experiments;
namespace fs = std::filesystem;

std::string quoted(const std::string& words) { return tr("“{}”", words); }

/// Adds the reason to what was done, if there is one.
std::string with_reason(const std::string& done, const std::string& reason) {
  return reason.empty() ? done : tr("{}: {}", done, reason);
}

/// The day and the time, such as "today at 14:05"; for a session without a date, the time since
/// it began.
std::string moment_words(std::int64_t time_ns, std::int64_t now_ns, double at_s) {
  const std::string day = day_in_words(time_ns, now_ns);
  if (!day.empty()) return day + hour_in_words(time_ns);
  return at_s < 0.0 ? std::string("-") : tr("{} after the begin", duration_words(at_s));
}

/// What a trial presents, for people who may know it.
std::string presented_words(const Block& block, const PlannedTrial& trial) {
  std::string words;
  const std::optional<double> level =
      trial.intensity ? trial.intensity : trial.starting_intensity;
  if (level) {
    words = level_words(block.quantity, *level);
    if (!trial.intensity) words = tr("from {}", words);
  }
  if (trial.is_catch) words = words.empty() ? tr("catch trial") : tr("{}, catch trial", words);
  if (trial.target_percent) {
    words += (words.empty() ? "" : ", ") + tr("target {:g} %", *trial.target_percent);
  }
  if (trial.reference_intensity) {
    const MediumSetting reference = setting_of(block, "reference", *trial.reference_intensity);
    words += (words.empty() ? "" : ", ") +
             tr("reference {}", reference.medium == block.medium
                                    ? level_words(reference.quantity, reference.intensity)
                                    : words_of(reference));
  }
  return words;
}

/// Reads the log of a session from its first event to its last.
class RecordReader {
 public:
  RecordReader(const Study& study, const core::SessionRow& row, SessionRecord& record,
               std::int64_t now_ns)
      : study_(study),
        row_(row),
        stages_(stages_of_session(study, row.cells)),
        titles_(shown_titles(stages_, study.languages.front(), record.hides_levels)),
        forms_{.study = study,
               .language = study.languages.front(),
               .hides_intensity = record.hides_levels},
        record_(record),
        now_ns_(now_ns) {}

  void read(const Event& event) {
    const bool was_over = state_.ended;
    const std::int64_t before_ns = state_.visit_last_ns;
    // Called before the event is applied, because the history tells what an answer was before.
    std::visit([&](const auto& data) { before(data); }, event.data);
    apply(state_, event);
    // What is done to a session afterwards belongs to no visit.
    if (state_.started) told_ = 1e-9 * static_cast<double>(state_.visited_ns());
    std::visit([&](const auto& data) { after(data, event, was_over); }, event.data);
    if (const auto* resumed = std::get_if<SessionResumed>(&event.data)) {
      after_gap(*resumed, event, before_ns);
    }
  }

  /// Fills in what the whole log decides.
  void finish(const std::vector<fs::path>& flight_records) {
    record_.duration_s = told_;
    end_pause(told_);
    for (RecordSpan& stage : record_.stages) {
      if (stage.end_s < stage.begin_s) stage.end_s = record_.duration_s;
    }
    add_answers();
    if (!record_.hides_levels) add_flight_records(flight_records);
    add_warnings();
    record_.is_over = state_.ended;
  }

 private:
  /// What is known about a trial besides its state.
  struct Past {
    double at_s = 0.0;                ///< When it was last answered.
    std::int64_t given_sequence = 0;  ///< The number of the event of that answer.
    std::vector<std::string> history;
  };

  [[nodiscard]] const Block& block_of_trial(const TrialState& trial) const {
    return std::get<Block>(stages_.at(static_cast<std::size_t>(trial.stage))->content);
  }
  [[nodiscard]] std::string answer_of_trial(const TrialState& trial) const {
    const Block& block = block_of_trial(trial);
    const AnswerKind kind = procedure_named(block.procedure).form(block).answer;
    std::optional<double> given;
    if (trial.response) {
      given = answer_of(kind, trial.planned, *trial.response, trial.measures.chosen_interval);
    }
    return forms_.in_words(block, given);
  }
  [[nodiscard]] std::string title_of_stage(std::int64_t stage) const {
    const auto index = static_cast<std::size_t>(stage);
    return index < titles_.size() ? titles_[index] : "";
  }
  void tell(std::int64_t trial, std::string words) {
    past_[trial].history.push_back(std::move(words));
  }

  // These see the state before the event changes it.
  template <typename Data>
  void before(const Data&) const {}
  void before(const AnswerUndone& e) {
    const std::string was = quoted(answer_of_trial(state_.trial(e.trial)));
    tell(e.trial, with_reason(tr("{} was taken back", was), e.reason));
  }
  void before(const AnswerCorrected& e) {
    const std::string was = quoted(answer_of_trial(state_.trial(e.trial)));
    tell(e.trial, with_reason(tr("was {} before", was), e.reason));
  }
  void before(const AttemptDiscarded& e) {
    tell(e.trial, with_reason(tr("attempt {} was given up", e.attempt), e.reason));
  }
  void before(const TrialExcluded& e) {
    tell(e.trial, with_reason(tr("left out of results"), e.reason));
  }
  void before(const TrialIncluded& e) {
    tell(e.trial, with_reason(tr("taken into results again"), e.reason));
  }

  // These see the state after the event has changed it.
  template <typename Data>
  void after(const Data&, const Event&, bool) const {}
  void after(const StageEntered& e, const Event&, bool) {
    record_.stages.push_back(
        {.title = title_of_stage(e.stage), .begin_s = told_, .end_s = told_ - 1.0});
  }
  void after(const StageFinished&, const Event&, bool) {
    if (!record_.stages.empty()) record_.stages.back().end_s = told_;
  }
  void after(const TrialAnswered& e, const Event& event, bool) {
    past_[e.trial].at_s = told_;
    past_[e.trial].given_sequence = event.sequence;
  }
  void after(const NoteAdded& e, const Event& event, bool was_over) {
    add_note(is_note_of_doubt(e.text) ? RecordNote::Kind::kAsked : RecordNote::Kind::kNote,
             e.text, event, was_over ? -1.0 : told_);
  }
  void after(const Paused& e, const Event& event, bool) {
    end_pause(told_);
    record_.pauses.push_back({.title = e.reason, .begin_s = told_});
    pause_is_open_ = true;
    if (!e.reason.empty()) add_note(RecordNote::Kind::kPause, e.reason, event, told_);
  }
  void after(const PauseExplained& e, const Event& event, bool) {
    if (!record_.pauses.empty()) record_.pauses.back().title = e.reason;
    add_note(RecordNote::Kind::kPause, e.reason, event, told_);
  }
  void after(const Continued&, const Event&, bool) { end_pause(told_); }
  void after(const SessionCompleted&, const Event&, bool) { end_pause(told_); }
  void after(const SessionEndedEarly& e, const Event& event, bool) {
    end_pause(told_);
    if (!e.reason.empty()) add_note(RecordNote::Kind::kEnd, e.reason, event, told_);
  }
  void after(const FaultRaised& e, const Event&, bool) {
    // The event stores the fault in English, as the loop names it.
    const std::string words = tr(e.fault.c_str());
    RecordFault fault{.words = words, .where = where(), .at_s = told_};
    if (!pause_is_open_) {
      record_.pauses.push_back({.title = tr("no force"), .begin_s = told_});
      pause_is_open_ = true;
    }
    record_.faults.push_back(std::move(fault));
    fault_ticks_.push_back(state_.last_tick);
  }
  void after(const GuardNoticed& e, const Event&, bool) {
    num_warnings_[e.guard] += e.num_warnings + e.num_shadowed;
  }
  void after(const SessionStarted& e, const Event&, bool) {
    if (!e.language.empty()) record_.facts.emplace_back(tr("Language"), e.language);
    for (const ParticipantField& field : study_.participant_fields) {
      const auto value = e.fields.find(field.name);
      if (value == e.fields.end()) continue;
      record_.facts.emplace_back(name_words(field.name, /*as_title=*/true),
                                 name_words(value->second));
    }
  }
  void after(const FittingKept& e, const Event&, bool) {
    for (const auto& [what, how] : e.fitting) {
      record_.facts.emplace_back(name_words(what, /*as_title=*/true), how);
    }
  }

  void after_gap(const SessionResumed&, const Event& event, std::int64_t before_ns) {
    end_pause(told_);
    const double gap_s = 1e-9 * static_cast<double>(event.time_ns - before_ns);
    record_.interruptions.push_back(
        {.title = gap_s > 0.0 ? tr("interrupted for {}", duration_words(gap_s))
                              : std::string(tr("interrupted")),
         .begin_s = told_,
         .end_s = told_});
  }

  void end_pause(double at_s) {
    if (!std::exchange(pause_is_open_, false)) return;
    record_.pauses.back().end_s = at_s;
  }

  void add_note(RecordNote::Kind kind, const std::string& text, const Event& event,
                double at_s) {
    record_.notes.push_back({.kind = kind,
                             .text = text,
                             .when = moment_words(event.time_ns, now_ns_, at_s),
                             .what = {.session = row_.session, .sequence = event.sequence},
                             .at_s = at_s});
  }

  /// Where the session is now, in words.
  [[nodiscard]] std::string where() const {
    std::string stage = title_of_stage(state_.stage);
    const std::optional<std::int64_t> trial = state_.current_trial();
    if (!trial || !state_.stage_open) return stage;
    return tr("{}, trial {}", stage, number_in_block(*trial));
  }

  [[nodiscard]] std::size_t first_together_of(std::size_t stage) const {
    std::size_t first = 0;
    while (first + num_run_together(stages_, first) <= stage) {
      first += num_run_together(stages_, first);
    }
    return first;
  }
  /// The trial's number as the list of a session under way counts it: in a group by the
  /// answers, otherwise by its place.
  [[nodiscard]] int number_in_block(std::int64_t number) const {
    const TrialState& its = state_.trial(number);
    const std::size_t first = first_together_of(static_cast<std::size_t>(its.stage));
    const bool is_group =
        stages_.at(static_cast<std::size_t>(its.stage))->interleaving.has_value();
    int place = 1;
    for (std::int64_t other = 1; other <= std::ssize(state_.trials); ++other) {
      const TrialState& trial = state_.trial(other);
      if (trial.is_void || other == number ||
          first_together_of(static_cast<std::size_t>(trial.stage)) != first) {
        continue;
      }
      const bool comes_before =
          is_group ? trial.is_answered &&
                         (!its.is_answered || given_sequence(other) < given_sequence(number))
                   : other < number;
      place += comes_before ? 1 : 0;
    }
    return place;
  }
  [[nodiscard]] std::int64_t given_sequence(std::int64_t trial) const {
    const auto found = past_.find(trial);
    return found == past_.end() ? 0 : found->second.given_sequence;
  }

  void add_answers() {
    std::vector<std::int64_t> order;
    for (std::int64_t number = 1; number <= std::ssize(state_.trials); ++number) {
      const TrialState& trial = state_.trial(number);
      if (trial.is_answered && !trial.is_void) order.push_back(number);
    }
    std::ranges::sort(order, {}, [&](std::int64_t number) { return given_sequence(number); });
    for (const std::int64_t number : order) record_.answers.push_back(answer_line(number));
  }

  [[nodiscard]] RecordAnswer answer_line(std::int64_t number) {
    const TrialState& trial = state_.trial(number);
    const Block& block = block_of_trial(trial);
    RecordAnswer line{.trial = number,
                      .block = title_of_stage(trial.stage),
                      .in_block = number_in_block(number),
                      .answer = answer_of_trial(trial),
                      .form = forms_.form_of(block),
                      .response_time_s = trial.measures.response_time_s,
                      .at_s = past_[number].at_s,
                      .attempt = trial.attempt,
                      .excluded = trial.excluded,
                      .history = past_[number].history};
    if (!record_.hides_levels) line.stimulus = presented_words(block, trial.planned);
    const AnswerGiven given{.state = state_,
                            .trial = trial,
                            .block = block,
                            .rate_hz = row_.rate_hz,
                            .hides_levels = record_.hides_levels};
    line.hint = shown_doubts(doubts_about(given.with(line.form.kind, trial.response)));
    return line;
  }

  /// Assigns flight records to faults. A file is named by the tick of its fault, which comes
  /// after everything that was felt before the fault. The search goes backwards from the last
  /// one, because a fault may have stored no file.
  void add_flight_records(const std::vector<fs::path>& files) {
    std::size_t fault = record_.faults.size();
    for (std::size_t later = files.size(); later > 0; --later) {
      const fs::path& file = files[later - 1];
      const std::string name = file.stem().string();
      const std::int64_t tick = std::atoll(name.substr(name.rfind('-') + 1).c_str());
      while (fault > 0 && fault_ticks_[fault - 1] > tick) --fault;
      if (fault == 0) return;
      record_.faults[--fault].flight_record = file;
    }
  }

  void add_warnings() {
    for (const auto& [guard, num] : num_warnings_) {
      if (num > 0) {
        record_.warnings.push_back(
            trn("{1}: {0} warning", "{1}: {0} warnings", num, name_words(guard, true)));
      }
    }
  }

  const Study& study_;
  const core::SessionRow& row_;
  std::vector<const Stage*> stages_;
  std::vector<std::string> titles_;
  AnswerForms forms_;
  SessionRecord& record_;
  std::int64_t now_ns_;
  SessionState state_;
  double told_ = 0.0;  ///< The time of the last event, as in `RecordSpan`.
  bool pause_is_open_ = false;
  std::map<std::int64_t, Past> past_;  ///< The answers so far, by trial number.
  std::vector<std::int64_t> fault_ticks_;
  std::map<std::string, std::int64_t> num_warnings_;
};

SessionLine line_in(const StudyFolder& study, std::int64_t session) {
  const auto found = std::ranges::find(study.sessions, session, &SessionLine::session);
  if (found != study.sessions.end()) return *found;
  throw core::Error(
      tr("{}: expected session {}, found none of that number", study.folder.string(), session));
}

void add_adverse_events(const core::StudyStore& store, std::int64_t now_ns,
                        SessionRecord& record) {
  for (const core::AdverseEventRow& row : store.adverse_events()) {
    if (row.session != record.line.session) continue;
    record.notes.push_back({.kind = RecordNote::Kind::kAdverseEvent,
                            .text = row.text,
                            .when = moment_words(row.time_ns, now_ns, -1.0),
                            .what = {.adverse_event = row.adverse_event}});
  }
}

void mark_read(const fs::path& folder, SessionRecord& record) {
  const std::vector<core::Acknowledgement> read = core::acknowledgements(folder);
  for (RecordNote& note : record.notes) {
    note.is_read =
        std::ranges::find(read, note.what, &core::Acknowledgement::what) != read.end();
  }
}

}  // namespace

bool is_new(const RecordNote& note) noexcept {
  const bool is_written =
      note.kind == RecordNote::Kind::kNote || note.kind == RecordNote::Kind::kAdverseEvent;
  return is_written && !note.is_read;
}

int SessionRecord::num_unread() const {
  return static_cast<int>(std::ranges::count_if(notes, is_new));
}

SessionRecord session_record(const fs::path& folder, std::int64_t session,
                             std::int64_t now_ns) {
  const StudyFolder opened = open_study_folder(folder, now_ns);
  const core::StudyStore store(folder, core::StudyStore::Mode::kReadOnly);
  SessionRecord record{.line = line_in(opened, session),
                       .hides_levels = opened.hides_levels,
                       .is_backup = opened.is_backup};
  const core::SessionRow row = store.session(session);
  const Study study = stored_study(store, session);
  record.rate_hz = row.rate_hz;
  RecordReader reader(study, row, record, now_ns);
  for (const core::EventRow& event : store.events(session)) reader.read(event_from_row(event));
  reader.finish(core::flight_records(store.recording_file(session)));
  std::ranges::reverse(record.notes);
  add_adverse_events(store, now_ns, record);
  std::stable_partition(record.notes.begin(), record.notes.end(), [](const RecordNote& note) {
    return note.kind == RecordNote::Kind::kAdverseEvent;
  });
  mark_read(folder, record);
  record.facts.emplace_back(tr("Device"), row.device);
  record.facts.emplace_back(tr("Loop"), row.realtime);
  record.facts.emplace_back(tr("Program"), row.program_version);
  record.facts.emplace_back(tr("Samples"), row.recorded ? tr("kept") : tr("not kept"));
  return record;
}

bool is_found(const RecordNote& note, const std::string& searched) {
  const auto small = [](std::string words) {
    std::ranges::transform(words, words.begin(), [](unsigned char letter) {
      return static_cast<char>(std::tolower(letter));
    });
    return words;
  };
  return small(note.text).find(small(searched)) != std::string::npos;
}

}  // namespace jnd::app
