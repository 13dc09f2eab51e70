#include "app/gui/application/record_screen.h"

#include <utility>

#include "app/language/words.h"
#include "app/operator/open_outside.h"
#include "app/operator/record_acts.h"
#include "core/error.h"

namespace jnd::app::gui {

namespace fs = std::filesystem;

void RecordScreen::choose(std::int64_t session) {
  if (session != session_) {
    state_ = {};
    record_.reset();
  }
  session_ = session;
}

void RecordScreen::show() {
  study_.reload();
  shown_fault_.reset();
  flight_.reset();
  read();
}

void RecordScreen::forget_study() {
  task_.reset();
  record_.reset();
  state_ = {};
  session_ = 0;
}

void RecordScreen::read() {
  problem_.clear();
  task_ = std::make_unique<BackgroundTask<SessionRecord>>(
      [folder = study_.folder().folder, session = session_](WorkControl&) {
        return session_record(folder, session);
      },
      host_.wake());
}

/// Takes what was read when reading has ended; until then the old contents stay on the screen.
void RecordScreen::update(Ui&) {
  if (was_withdrawing_ && !study_.works()) {
    was_withdrawing_ = false;
    // The sessions of the withdrawn person are gone, or the outcome says why they are not.
    return host_.go_to(StudyTab::kSessions);
  }
  if (!task_ || task_->running()) return;
  if (task_->result() != nullptr) {
    record_ = *task_->result();
  } else {
    record_.reset();
    problem_ = task_->error();
  }
  task_.reset();
}

void RecordScreen::look_at_fault() {
  if (state_.page != RecordPage::kFaults || !record_ || shown_fault_ == state_.fault) return;
  shown_fault_ = state_.fault;
  flight_.reset();
  flight_problem_.clear();
  if (!state_.fault || *state_.fault >= record_->faults.size()) return;
  const fs::path& file = record_->faults[*state_.fault].flight_record;
  if (file.empty()) return;
  try {
    flight_ = read_flight_record(file, record_->rate_hz);
  } catch (const core::Error& error) {
    flight_problem_ = error.what();
  }
}

void RecordScreen::draw(Ui& ui) {
  look_at_fault();
  const RecordViewResult result = draw_record_view(ui,
                                                   {.study = study_.folder(),
                                                    .record = record_ ? &*record_ : nullptr,
                                                    .problem = problem_,
                                                    .flight = flight_ ? &*flight_ : nullptr,
                                                    .flight_problem = flight_problem_,
                                                    .work = study_.work()},
                                                   state_);
  if (result.cancel) study_.cancel_work();
  if (result.resume) {
    host_.attempt(tr("The session cannot be resumed"),
                  [&] { host_.resume_session(study_.folder().folder, session_); });
  } else if (result.open) {
    const std::string problem = open_outside(*result.open);
    if (!problem.empty()) host_.tell(tr("It cannot be opened"), problem);
  } else if (result.withdraw) {
    was_withdrawing_ = true;
    study_.begin_work(tr("Withdrawing"),
                      [folder = study_.folder().folder,
                       participant = record_->line.participant](WorkControl& control) {
                        return withdraw_participant(folder, participant, control);
                      });
  } else if (result.tab != StudyTab::kNone) {
    host_.go_to(result.tab);
  } else {
    act(result);
  }
}

/// Carries out an act that is stored at once, and reads the session again.
void RecordScreen::act(const RecordViewResult& result) {
  const fs::path folder = study_.folder().folder;
  const char* failed = tr("It cannot be stored");
  bool is_done = false;
  if (result.correct) {
    is_done = host_.attempt(failed, [&] {
      correct_answer(folder, session_, result.correct->trial, result.correct->value,
                     result.correct->reason);
    });
  } else if (result.exclude) {
    is_done = host_.attempt(failed, [&] {
      (void)exclude_trials(folder, session_, result.exclude->trials, result.exclude->reason,
                           result.exclude->include);
    });
  } else if (result.note) {
    is_done = host_.attempt(failed, [&] { add_note(folder, session_, *result.note); });
  } else if (result.adverse_event) {
    is_done = host_.attempt(
        failed, [&] { add_adverse_event(folder, session_, *result.adverse_event); });
  } else if (result.acknowledge) {
    is_done = host_.attempt(failed, [&] { acknowledge_note(folder, *result.acknowledge); });
  }
  if (is_done) host_.attempt(tr("The study cannot be read"), [this] { show(); });
}

}  // namespace jnd::app::gui
