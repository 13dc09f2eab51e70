#include "app/gui/application/session_screen.h"

#include <algorithm>
#include <exception>
#include <optional>
#include <utility>

#include "app/language/words.h"
#include "app/operator/remembered_stop.h"
#include "app/operator/study_words.h"
#include "app/profile/profile_choice.h"
#include "app/session/session_setup.h"
#include "app/session/shipped_files.h"
#include "app/session/stored_session.h"
#include "device/haptic_device.h"
#include "device/registry/device_registry.h"

namespace jnd::app::gui {

namespace fs = std::filesystem;

namespace {

/// The laboratory of a simulated hand that moves by itself; nullptr where a person moves the
/// hand.
std::unique_ptr<experiments::Laboratory> laboratory_for(const std::string& device,
                                                        double rate_hz) {
  if (!device::make_device(device, rate_hz)->capabilities().moves_by_itself) return nullptr;
  return std::make_unique<experiments::Laboratory>(experiments::read_laboratory(
      user_or_shipped(default_laboratory(device), "data/laboratories")));
}

}  // namespace

/// What was measured of the device, if anything. Throws `core::Error` if the session needs a
/// profile and there is none that fits.
static std::optional<KnownProfile> profile_for(const NewSession& session,
                                               const experiments::Study& study) {
  const DeviceOfProfile device = device_of_profile(session.device, study.device.rate_hz);
  ProfileChoice choice =
      choose_profile(device, session.device_profile, profile_folders(), today());
  const std::string refused = refused_words(device, choice, study);
  if (!refused.empty()) throw core::Error(refused);
  return std::move(choice.known);
}

void SessionScreen::start(const NewSession& session) {
  const experiments::Study& study = study_.study();
  const std::optional<KnownProfile> profile = profile_for(session, study);
  auto store = std::make_unique<core::StudyStore>(study_.folder().folder,
                                                  core::StudyStore::Mode::kReadWrite);
  const std::unique_ptr<experiments::Laboratory> laboratory =
      laboratory_for(session.device, study.device.rate_hz);
  const std::int64_t number = add_sessions(*store,
                                           {.study = study,
                                            .laboratory = laboratory.get(),
                                            .study_file = study_.folder().study_file,
                                            .device = session.device,
                                            .profile = profile ? &*profile : nullptr,
                                            .seed = session.seed,
                                            .pilot = session.pilot,
                                            .realtime = !simulated_clock_s_,
                                            .allow_no_realtime = allow_no_realtime_,
                                            .fields = session.fields},
                                           {session.participant})
                                  .front();
  run(std::move(store), number,
      session.language.empty() ? shown_language(study.languages) : session.language,
      session.sound_output, session.fitting);
}

void SessionScreen::resume(std::int64_t session) {
  auto store = std::make_unique<core::StudyStore>(study_.folder().folder,
                                                  core::StudyStore::Mode::kReadWrite);
  const core::SessionRow row = store->session(session);
  try {
    const std::string refused = refused_resume_words(
        *store, row, stored_study(*store, session), device_of_profile(row.device, row.rate_hz),
        device_profile_, profile_folders(), today());
    if (!refused.empty()) throw core::Error(refused);
  } catch (const device::DeviceUnreachable&) {
    // The session itself tells that the device is unreachable, and tries again.
  }
  run(std::move(store), session, /*language=*/"", sound_output_);
}

void SessionScreen::run(std::unique_ptr<core::StudyStore> store, std::int64_t session,
                        const std::string& language, const std::string& sound_output,
                        const std::map<std::string, std::string>& fitting) {
  const core::SessionRow row = store->session(session);
  experiments::Study study = stored_study(*store, session);
  std::unique_ptr<experiments::Laboratory> laboratory;
  if (!row.laboratory.empty()) {
    laboratory = std::make_unique<experiments::Laboratory>(experiments::parse_laboratory(
        row.laboratory, store->folder().string() + as_is(": laboratory")));
  }
  check_.reset();
  backup_.reset();
  after_ = {};
  run_state_ = {};
  apparatus_state_.held.reset();
  apparatus_state_.scopes.choosing.reset();
  view_.reset();
  finished_ = false;
  closing_ = leaving_ = false;
  folder_ = store->folder();
  worker_ = std::make_unique<SessionWorker>(
      SessionWorker::Parameters{.store = std::move(store),
                                .session = session,
                                .study = std::move(study),
                                .laboratory = std::move(laboratory),
                                .language = language,
                                .fitting = fitting,
                                .allow_no_realtime = allow_no_realtime_,
                                .stops = stops_folder(),
                                .streams = streams_,
                                .sound = {.output = sound_output},
                                .markers = markers_,
                                .controls = controls_.words(),
                                .simulated_clock_s = simulated_clock_s_,
                                .wake = host_.wake()},
      exchange_);
  controls_.begin_session(
      [worker = worker_.get()](const operate::UseControl& use) { worker->request(use); });
}

bool SessionScreen::works() const noexcept {
  return (check_ && check_->running()) || (backup_ && backup_->running());
}

void SessionScreen::cursor(float x, float y) noexcept {
  const Rect& pad = run_state_.pad;
  if (worker_ == nullptr || pad.width <= 0) return;
  const double dx = std::clamp(x, pad.x, pad.right()) - (pad.x + pad.width / 2);
  const double dy = std::clamp(y, pad.y, pad.bottom()) - (pad.y + pad.height / 2);
  exchange_.pointer.publish({.sequence = ++pointer_sequence_,
                             .x_m = dx * run_state_.pad_m_per_px,
                             .y_m = -dy * run_state_.pad_m_per_px});
}

std::string SessionScreen::typed_answer() const {
  if (view_ == nullptr) return "";
  if (const auto& item = view_->item; item && item->kind == ItemView::Kind::kNumber) {
    const std::string shown = item->name + "/" + std::to_string(item->trial);
    return run_state_.item == shown ? run_state_.typed : "";
  }
  if (!view_->trial) return "";
  const bool is_its = run_state_.percent_trial == view_->trial->trial &&
                      run_state_.percent_attempt == view_->trial->attempt;
  return is_its ? run_state_.percent : "";
}

void SessionScreen::ask_to_close() {
  closing_ = true;
  ask_to_leave(run_state_);
}

void SessionScreen::leave_and_close(const std::string& reason) {
  if (std::exchange(closing_, true)) return;
  leaving_ = true;
  worker_->request(operate::Leave{reason});
}

/// Holds the input while an act is being carried out, because keys pressed now are meant for
/// what follows it. The hold ends after a short time, so that a hanging disk or a long rest
/// does not keep the operator from everything else.
void SessionScreen::hold_input(Ui& ui, bool is_behind, bool requests_wait) const {
  constexpr auto kMostForTheDisk = std::chrono::seconds(1);
  constexpr auto kMostForARamp = std::chrono::milliseconds(300);
  const auto waited = std::chrono::steady_clock::now() - requested_at_;
  if ((is_behind && waited < kMostForTheDisk) || (requests_wait && waited < kMostForARamp)) {
    ui.hold_input();
  }
}

void SessionScreen::update(Ui& ui) {
  if (!worker_) return;
  // Asked before the view is taken, so that the view shows at least everything that was asked
  // about.
  hold_input(ui, worker_->is_behind(), worker_->has_waiting_requests());
  if (auto newest = worker_->view()) view_ = std::move(newest);
  if (worker_->over()) close_session();
}

void SessionScreen::draw(Ui& ui) {
  if (!view_) {
    ui.text(ui.screen(), tr("Starting the device …"),
            {.font = Font::kTitle, .colour = Colour::kSoft, .align = Align::kCentre});
    return;
  }
  after_session();
  const RunViewResult result = draw_session_view(ui);
  if (worker_) {
    if (result.stop) press_stop();
    if (!result.requests.empty()) requested_at_ = std::chrono::steady_clock::now();
    for (const OperatorRequest& request : result.requests) worker_->request(request);
  }
  // Leaving a session takes a moment.
  if (result.to_sessions) leaving_ = true;
  if (closing_ && run_state_.dialog == RunViewState::Dialog::kNone && !leaving_) {
    closing_ = false;  // The person decided to stay.
  }
  if (result.back_up && backup_ == nullptr) begin_backup(after_.backup_folder);
  if (worker_ == nullptr && result.to_results) {
    host_.go_to(StudyTab::kResults);
  } else if (worker_ == nullptr && result.to_sessions) {
    // The overview shows who comes next; a participant who was alone goes to the sessions.
    host_.go_to(finished_ && !view_->is_alone ? StudyTab::kOverview : StudyTab::kSessions);
  }
}

RunViewResult SessionScreen::draw_session_view(Ui& ui) {
  const bool is_over = view_->step == Step::kFinished || view_->step == Step::kFailed;
  if (is_over || view_->is_alone) run_state_.shows_apparatus = false;
  if (run_state_.shows_apparatus) {
    return draw_apparatus_view(ui, *view_, apparatus_sources(), run_state_, apparatus_state_);
  }
  apparatus_state_.held.reset();
  const std::vector<TracePoint> trace =
      worker_ && !view_->hides_levels ? worker_->trace().snapshot() : std::vector<TracePoint>{};
  return draw_run_view(ui, *view_, trace, after_, run_state_);
}

ApparatusSources SessionScreen::apparatus_sources() {
  ApparatusSources sources{.paint_problem = paint_problem_};
  if (worker_) {
    sources.scopes = [this](const std::vector<std::string>& names) {
      return worker_->scopes().snapshot(names);
    };
  }
  if (paint_scene && paint_problem_.empty()) {
    sources.paint = [this](const SceneRequest& request) -> std::uintptr_t {
      try {
        return paint_scene(request);
      } catch (const std::exception& error) {
        paint_problem_ = error.what();
        return 0;
      }
    };
  }
  return sources;
}

/// The session is over (left, failed or finished) and its folder is closed.
void SessionScreen::close_session() {
  const std::string failure = worker_->failure();
  controls_.end_session();
  worker_.reset();
  run_state_.pad = {};
  finished_ = view_ && view_->step == Step::kFinished;
  if (closing_) host_.close();
  if (finished_) return;
  if (!failure.empty()) host_.tell(tr("The session stopped"), failure);
  host_.go_to(StudyTab::kSessions);
  // The study's folder may be gone together with its disk.
  if (host_.shows(*this)) host_.go_to(StudyTab::kStart);
}

/// After a finished session, closes its folder, checks it, and backs it up if a backup is
/// known.
void SessionScreen::after_session() {
  if (worker_ && view_->step == Step::kFinished) {
    worker_->request(operate::Leave{});
    return;
  }
  if (!finished_) return;
  if (check_ == nullptr) {
    host_.attempt(tr("The study cannot be read"), [this] { study_.reload(); });
    const std::vector<fs::path>& backups = study_.folder().backups;
    after_.backup_folder = backups.empty() ? free_folder_beside(folder_, "backup").string()
                                           : backups.front().string();
    check_ = std::make_unique<BackgroundTask<ActionOutcome>>(
        [folder = folder_](WorkControl& control) { return verify_study(folder, control); },
        host_.wake());
    if (!backups.empty()) begin_backup(backups.front());
  }
  const auto collect = [&](BackgroundTask<ActionOutcome>& task, bool& running,
                           std::string& sentence, bool& failed) {
    running = task.running();
    if (running) {
      after_.progress = task.progress();
    } else if (const ActionOutcome* outcome = task.result()) {
      sentence = outcome->sentence;
      failed = !outcome->ok;
    } else {
      sentence = task.error();
      failed = true;
    }
  };
  collect(*check_, after_.checking, after_.check, after_.check_failed);
  if (backup_) {
    collect(*backup_, after_.backing_up, after_.backup, after_.backup_failed);
    const ActionOutcome* outcome = after_.backing_up ? nullptr : backup_->result();
    after_.backup_has_caution = outcome != nullptr && outcome->caution;
    if (!after_.backing_up && after_.backup_failed) backup_.reset();
  }
}

void SessionScreen::begin_backup(const fs::path& target) {
  backup_ = std::make_unique<BackgroundTask<ActionOutcome>>(
      [folder = folder_, target](WorkControl& control) {
        return back_up_study(folder, target, control);
      },
      host_.wake());
}

}  // namespace jnd::app::gui
