// A session in the window: from its start or resumption to the check and copy after it.

#include <exception>
#include <utility>

#include "app/gui/application/application.h"
#include "app/operator/remembered_stop.h"
#include "app/session/session_setup.h"
#include "app/session/shipped_files.h"
#include "core/clock.h"
#include "core/error.h"
#include "device/registry/device_registry.h"
#include "experiments/protocol/study_reader.h"

namespace jnd::app::gui {

namespace fs = std::filesystem;

namespace {

/// Of a hand that moves by itself; nothing where a person moves it.
std::unique_ptr<experiments::Laboratory> laboratory_for(const std::string& device,
                                                        double rate_hz) {
  if (!device::make_device(device, rate_hz)->capabilities().moves_by_itself) return nullptr;
  return std::make_unique<experiments::Laboratory>(experiments::read_laboratory(
      user_or_shipped(default_laboratory(device), "data/laboratories")));
}

}  // namespace

void Application::start_tour() {
  const fs::path folder = default_study_folder("short_tour");
  const fs::path file = user_or_shipped("short_tour", "protocols");
  create_study_folder(file, folder);
  open_folder(folder);
  seed_ = static_cast<std::uint64_t>(core::SystemClock().now_ns());
  prepare_state_.language = study_->languages.front();
  prepare_state_.fields.clear();
  start_session("P01", "mouse");
}

void Application::start_session(const std::string& participant, const std::string& device) {
  auto store =
      std::make_unique<core::StudyStore>(folder_->folder, core::StudyStore::Mode::kReadWrite);
  const std::unique_ptr<experiments::Laboratory> laboratory =
      laboratory_for(device, study_->device.rate_hz);
  const std::int64_t session = add_sessions(*store,
                                            {.study = *study_,
                                             .laboratory = laboratory.get(),
                                             .study_file = folder_->study_file,
                                             .device = device,
                                             .seed = seed_,
                                             .pilot = prepare_state_.pilot,
                                             .realtime = true,
                                             .allow_no_realtime = request_.allow_no_realtime,
                                             .fields = prepare_state_.fields},
                                            {participant})
                                   .front();
  run(std::move(store), session);
}

void Application::resume_session(const fs::path& folder, std::int64_t session) {
  open_folder(folder);
  auto store = std::make_unique<core::StudyStore>(folder, core::StudyStore::Mode::kReadWrite);
  prepare_state_.language = "";
  run(std::move(store), session);
}

void Application::run(std::unique_ptr<core::StudyStore> store, std::int64_t session) {
  const core::SessionRow row = store->session(session);
  experiments::Study study = stored_study(*store, session);
  std::unique_ptr<experiments::Laboratory> laboratory;
  if (!row.laboratory.empty()) {
    laboratory = std::make_unique<experiments::Laboratory>(experiments::parse_laboratory(
        row.laboratory, store->folder().string() + ": laboratory"));
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
  session_folder_ = store->folder();
  worker_ = std::make_unique<SessionWorker>(
      SessionWorker::Parameters{.store = std::move(store),
                                .session = session,
                                .study = std::move(study),
                                .laboratory = std::move(laboratory),
                                .language = prepare_state_.language,
                                .allow_no_realtime = request_.allow_no_realtime,
                                .stops = stops_folder(),
                                .wake = wake_},
      exchange_);
  screen_ = Screen::kSession;
}

/// Keys pressed while an act is being carried out are meant for what it leads to. A disk that
/// hangs or a long rest must not keep the operator from everything else, though.
void Application::hold_input(Ui& ui, bool is_behind, bool requests_wait) const {
  constexpr auto kMostForTheDisk = std::chrono::seconds(1);
  constexpr auto kMostForARamp = std::chrono::milliseconds(300);
  const auto waited = std::chrono::steady_clock::now() - requested_at_;
  if ((is_behind && waited < kMostForTheDisk) || (requests_wait && waited < kMostForARamp)) {
    ui.hold_input();
  }
}

void Application::draw_session(Ui& ui) {
  if (worker_) {
    // Before the view, which then shows at least as much.
    hold_input(ui, worker_->is_behind(), worker_->has_waiting_requests());
    if (auto newest = worker_->view()) view_ = std::move(newest);
    if (worker_->over()) close_session();
  }
  if (screen_ != Screen::kSession) return draw_sessions(ui);
  if (!view_) {
    ui.text(ui.screen(), "Starting the device …",
            {.font = Font::kTitle, .colour = Colour::kSoft, .align = Align::kCentre});
    return;
  }
  after_session();
  const RunViewResult result = draw_session_view(ui);
  if (result.stop) escape();
  if (worker_) {
    if (!result.requests.empty()) requested_at_ = std::chrono::steady_clock::now();
    for (const OperatorRequest& request : result.requests) worker_->request(request);
  }
  // It takes the session a moment to be left.
  if (result.to_sessions) leaving_ = true;
  if (closing_ && run_state_.dialog == RunViewState::Dialog::kNone && !leaving_) {
    closing_ = false;  // They stay.
  }
  if (result.back_up && backup_ == nullptr) {
    backup_ = std::make_unique<BackgroundTask<ActionOutcome>>(
        [folder = session_folder_, target = fs::path(after_.backup_folder)](
            WorkControl& control) { return back_up_study(folder, target, control); },
        wake_);
  }
  if (worker_ == nullptr && result.to_results) {
    go_to(StudyTab::kResults);
  } else if (worker_ == nullptr && result.to_sessions) {
    go_to(StudyTab::kSessions);
  }
}

RunViewResult Application::draw_session_view(Ui& ui) {
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

ApparatusSources Application::apparatus_sources() {
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

/// The session is over and its folder closed: left, failed, or finished.
void Application::close_session() {
  const std::string failure = worker_->failure();
  worker_.reset();
  run_state_.pad = {};
  finished_ = view_ && view_->step == Step::kFinished;
  if (closing_) closed_ = true;
  if (finished_) return;
  if (!failure.empty()) tell("The session stopped", failure);
  go_to(StudyTab::kSessions);
}

/// Once a session is finished its folder is closed, checked, and copied where a copy is known.
void Application::after_session() {
  if (worker_ && view_->step == Step::kFinished) {
    worker_->request(operate::Leave{});
    return;
  }
  if (!finished_) return;
  if (check_ == nullptr) {
    attempt("The study cannot be read", [this] { reload_folder(); });
    after_.backup_folder = folder_->backups.empty()
                               ? free_folder_beside(session_folder_, "backup").string()
                               : folder_->backups.front().string();
    check_ = std::make_unique<BackgroundTask<ActionOutcome>>(
        [folder = session_folder_](WorkControl& control) {
          return verify_study(folder, control);
        },
        wake_);
    if (!folder_->backups.empty()) {
      backup_ = std::make_unique<BackgroundTask<ActionOutcome>>(
          [folder = session_folder_, target = folder_->backups.front()](WorkControl& control) {
            return back_up_study(folder, target, control);
          },
          wake_);
    }
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

}  // namespace jnd::app::gui
