#include "app/gui/application/application.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

#include "app/gui/application/start_contents.h"
#include "app/gui/views/keys_dialog.h"
#include "app/gui/views/participant_view.h"
#include "app/session/session_setup.h"
#include "app/session/shipped_files.h"
#include "core/clock.h"
#include "core/error.h"
#include "core/random_stream.h"
#include "device/registry/device_registry.h"
#include "experiments/protocol/study_reader.h"

namespace jnd::app::gui {
namespace {

namespace fs = std::filesystem;

constexpr float kZoomStep = 1.1f;

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// Those that need no address, and the one that was asked for. Not for every frame: a simulated
/// device is a world of its own.
std::vector<PrepareModel::Device> devices_to_choose(const std::string& asked, double rate_hz) {
  std::vector<PrepareModel::Device> all;
  const auto add = [&](const std::string& name, std::string_view description) {
    all.push_back({name, std::string(description),
                   device::make_device(name, rate_hz)->capabilities().simulated});
  };
  for (const device::DeviceEntry& entry : device::devices()) {
    if (entry.argument.empty()) add(std::string(entry.name), entry.description);
  }
  const device::DeviceEntry& entry = device::device_named(asked);
  if (!entry.argument.empty()) add(asked, entry.description);
  return all;
}

/// "NAME-results-1.png" beside the study, or whichever does not exist yet.
fs::path free_picture_beside(const fs::path& study_folder) {
  for (int number = 1;; ++number) {
    fs::path file = study_folder.parent_path() / (study_folder.stem().string() + "-results-" +
                                                  std::to_string(number) + ".png");
    if (!fs::exists(file)) return file;
  }
}

/// One for each study folder, so that the orders shown are those its sessions will draw.
std::uint64_t seed_of(const core::StudyStore& store) {
  return core::derived_seed(0, "study/" + store.study_id());
}

}  // namespace

Application::Application(WindowRequest request, std::function<void()> wake)
    : request_(std::move(request)),
      wake_(std::move(wake)),
      participant_stop_(ParticipantStop::key_named(request_.participant_stop),
                        request_.participant_holds ? ParticipantStop::Way::kHold
                                                   : ParticipantStop::Way::kPress) {
  show_start();
  if (request_.resume_session) {
    attempt("The session cannot be resumed",
            [this] { resume_session(request_.study_folder, *request_.resume_session); });
  } else if (!request_.study_folder.empty()) {
    attempt("The study cannot be opened", [this] {
      if (!request_.study_file.empty() && !fs::exists(request_.study_folder / "study.sqlite")) {
        create_study_folder(request_.study_file, request_.study_folder);
      }
      open_folder(request_.study_folder);
      if (!request_.participant.empty()) {
        show_prepare();
      } else if (request_.shows_results) {
        show_results();
      }
    });
  }
}

Application::~Application() = default;

const char* Application::view_name() const noexcept {
  switch (screen_) {
    case Screen::kStart:
      return "start";
    case Screen::kPrepare:
      return "prepare";
    case Screen::kSession:
      return run_state_.shows_apparatus ? "apparatus" : "session";
    case Screen::kSessions:
      return "sessions";
    case Screen::kResults:
      return "results";
    case Screen::kStudy:
      return "study";
  }
  return "";
}

bool Application::works() const noexcept {
  return (start_task_ && start_task_->running()) || (work_ && work_->running()) ||
         (results_task_ && results_task_->running()) || (preflight_ && preflight_->running()) ||
         (check_ && check_->running()) || (backup_ && backup_->running());
}

std::optional<fs::path> Application::take_picture_request() {
  return std::exchange(picture_, std::nullopt);
}

void Application::picture_saved(const fs::path& file, const std::string& problem) {
  outcome_ = {.ok = problem.empty(),
              .sentence = problem.empty() ? "The picture is in " + file.string() : problem};
}

void Application::escape() noexcept {
  if (worker_ != nullptr) {
    exchange_.emergency_stop.press();
  } else if (preflight_ != nullptr) {
    preflight_->press_emergency_stop();
  }
}

void Application::key_changed(Key key, bool is_down) noexcept {
  if (participant_stop_.key_changed(key, is_down)) escape();
}

/// Released by the experimenter while nobody holds the participant's switch.
void Application::keep_stopped() noexcept {
  if (worker_ != nullptr && participant_stop_.is_let_go() &&
      !exchange_.emergency_stop.is_pressed()) {
    escape();
  }
}

void Application::mouse_pressed(float x, float y) noexcept {
  if (stop_place_.contains(x, y)) escape();
}

void Application::end_soon() {
  if (worker_ == nullptr) {
    closed_ = true;
  } else if (!std::exchange(closing_, true)) {
    leaving_ = true;
    worker_->request(operate::Leave{"the program was told to end"});
  }
}

void Application::cursor(float x, float y) noexcept {
  const Rect& pad = run_state_.pad;
  if (worker_ == nullptr || pad.width <= 0) return;
  const double dx = std::clamp(x, pad.x, pad.right()) - (pad.x + pad.width / 2);
  const double dy = std::clamp(y, pad.y, pad.bottom()) - (pad.y + pad.height / 2);
  exchange_.pointer.publish({.sequence = ++pointer_sequence_,
                             .x_m = dx * run_state_.pad_m_per_px,
                             .y_m = -dy * run_state_.pad_m_per_px});
}

void Application::ask_to_close() {
  if (worker_ == nullptr) {
    closed_ = true;
    return;
  }
  closing_ = true;
  ask_to_leave(run_state_);
}

void Application::tell(const std::string& title, const std::string& sentence) {
  message_title_ = title;
  message_ = sentence;
}

void Application::attempt(const char* title, const std::function<void()>& work) {
  try {
    work();
  } catch (const std::exception& error) {
    tell(title, error.what());
  }
}

void Application::draw(Ui& ui) {
  collect_work();
  keep_stopped();
  run_state_.is_covered = shows_keys_ || !message_.empty();
  switch (screen_) {
    case Screen::kStart:
      draw_start(ui);
      break;
    case Screen::kPrepare:
      draw_prepare(ui);
      break;
    case Screen::kSession:
      draw_session(ui);
      break;
    case Screen::kSessions:
      draw_sessions(ui);
      break;
    case Screen::kResults:
      draw_results(ui);
      break;
    case Screen::kStudy:
      draw_study(ui);
      break;
  }
  draw_corner(ui);
  take_global_keys(ui);
  if (!shows_keys_) last_widgets_ = ui.drawn().widgets;
  if (!message_.empty()) {
    draw_message(ui);
  } else if (shows_keys_) {
    shows_keys_ = !draw_keys_dialog(ui, last_widgets_);
  }
  if (screen_ == Screen::kSession && view_ && run_state_.is_covered &&
      draw_emergency_stop(ui)) {
    escape();
  }
  const auto& widgets = ui.drawn().widgets;
  const auto stop = std::ranges::find(widgets, "emergency_stop", &Drawn::Widget::name);
  stop_place_ = stop == widgets.end() ? Rect{} : stop->place;
}

void Application::draw_participant(Ui& ui) {
  if (view_) return draw_participant_view(ui, *view_);
  ui.text(
      ui.screen().middle(ui.screen().width * 0.8f, 60),
      "What the participant is to see comes here with a session.",
      {.font = Font::kLarge, .colour = Colour::kSoft, .align = Align::kCentre, .wrap = true});
}

// The views, one after the other: what they show, and what their requests do.

void Application::show_start() {
  screen_ = Screen::kStart;
  start_state_.new_folder.clear();
  start_task_ = std::make_unique<BackgroundTask<StartModel>>(
      [recent = recent_](WorkControl& control) { return look_around(recent, control); }, wake_);
}

void Application::draw_start(Ui& ui) {
  if (const StartModel* model = start_task_ ? start_task_->result() : nullptr) start_ = *model;
  const StartViewResult result = draw_start_view(ui, start_, entries_of, start_state_);
  if (result.resume) {
    attempt("The session cannot be resumed",
            [&] { resume_session(result.resume->folder, result.resume->session); });
  } else if (result.open) {
    attempt("The study cannot be opened", [&] { open(*result.open); });
  } else if (result.create) {
    attempt("The study cannot be made", [&] {
      create_study_folder(user_or_shipped(result.create->study, "protocols"),
                          result.create->folder);
      open_folder(result.create->folder);
    });
  } else if (result.start_tour) {
    attempt("The tour cannot be started", [this] { start_tour(); });
  }
}

void Application::open(const fs::path& path) {
  if (fs::is_directory(path)) return open_folder(path);
  folder_.reset();
  study_.reset();
  watch_ = std::make_unique<StudyWatch>(path);
  recent_.add(fs::absolute(path), core::SystemClock().now_ns());
  show_study();
}

void Application::open_folder(const fs::path& folder) {
  folder_ = open_study_folder(folder);
  {
    const core::StudyStore store(folder, core::StudyStore::Mode::kReadOnly);
    study_ = study_in(store);
  }
  outcome_ = {};
  watch_.reset();
  results_task_.reset();
  sessions_state_ = {};
  results_state_ = {};
  prepare_state_ = {};
  try {
    recent_.add(fs::absolute(folder), core::SystemClock().now_ns());
  } catch (const core::Error&) {
    // A list that cannot be kept is no reason not to work.
  }
  show_sessions();
}

void Application::reload_folder() {
  if (folder_) folder_ = open_study_folder(folder_->folder);
}

void Application::show_sessions() {
  screen_ = Screen::kSessions;
  reload_folder();
  sessions_state_.backup_folder = folder_->backups.empty()
                                      ? free_folder_beside(folder_->folder, "backup").string()
                                      : folder_->backups.front().string();
}

void Application::draw_sessions(Ui& ui) {
  const SessionsViewResult result =
      draw_sessions_view(ui, *folder_, study_work(), sessions_state_);
  const fs::path folder = folder_->folder;
  if (result.cancel && work_) work_->cancel();
  if (result.new_session) {
    attempt("No session can be prepared", [this] { show_prepare(); });
  } else if (result.resume) {
    attempt("The session cannot be resumed", [&] { resume_session(folder, *result.resume); });
  } else if (result.verify) {
    begin_work("Verifying",
               [folder](WorkControl& control) { return verify_study(folder, control); });
  } else if (result.back_up) {
    begin_work("Backing up",
               [folder, target = fs::path(sessions_state_.backup_folder)](
                   WorkControl& control) { return back_up_study(folder, target, control); });
  } else {
    go_to(result.tab);
  }
}

void Application::go_to(StudyTab tab) {
  attempt("The view cannot be opened", [&] {
    if (tab == StudyTab::kStart) show_start();
    if (tab == StudyTab::kSessions) show_sessions();
    if (tab == StudyTab::kResults) show_results();
    if (tab == StudyTab::kStudy) show_study();
  });
}

void Application::show_prepare() {
  reload_folder();
  const core::StudyStore store(folder_->folder, core::StudyStore::Mode::kReadOnly);
  taken_.clear();
  for (const core::SessionRow& row : store.sessions()) taken_.push_back(row.participant);
  for (const core::WithdrawalRow& gone : store.withdrawals()) {
    taken_.push_back(gone.participant);
  }
  seed_ = request_.seed ? *request_.seed : seed_of(store);
  prepare_state_.fields = std::exchange(request_.fields, {});
  assign(store);
  prepare_state_.participant = request_.participant.empty()
                                   ? next_participants(store, 1).front()
                                   : std::exchange(request_.participant, "");
  prepare_state_.pilot = request_.pilot;
  if (prepare_state_.device.empty()) {
    prepare_state_.device =
        request_.device.empty() ? std::string(device::devices().front().name) : request_.device;
  }
  devices_ = devices_to_choose(prepare_state_.device, study_->device.rate_hz);
  prepare_state_.language = request_.language.empty() ? study_->languages.front()
                                                      : std::exchange(request_.language, "");
  screen_ = Screen::kPrepare;
  look_before();
}

void Application::assign(const core::StudyStore& store) {
  assigned_.clear();
  const bool knows_fields = field_problem(*study_, prepare_state_.fields).empty();
  if (folder_->hides_levels || !knows_fields) return;
  assigned_ =
      cell_words(experiments::planned_cells(*study_, experiments::completed_cells(store), seed_,
                                            static_cast<std::int64_t>(store.sessions().size()),
                                            1, prepare_state_.fields)
                     .front());
}

void Application::look_before() {
  preflight_ = std::make_unique<Preflight>(
      PreflightRequest{.folder = folder_->folder,
                       .device = prepare_state_.device,
                       .allow_no_realtime = request_.allow_no_realtime},
      wake_);
}

void Application::draw_prepare(Ui& ui) {
  PrepareModel model{.study = *folder_,
                     .languages = study_->languages,
                     .fields = study_->participant_fields,
                     .taken = taken_,
                     .assigned = assigned_,
                     .seed = seed_,
                     .lines = preflight_->lines(),
                     .looking = preflight_->running(),
                     .progress = preflight_->progress()};
  model.devices = devices_;
  const PrepareViewResult result = draw_prepare_view(ui, model, prepare_state_);
  if (result.start) {
    attempt("The session cannot be started", [this] {
      preflight_.reset();
      start_session(prepare_state_.participant, prepare_state_.device);
    });
    if (preflight_ == nullptr && screen_ == Screen::kPrepare) look_before();
  } else if (result.look_again) {
    look_before();
  } else if (result.fields_changed) {
    attempt("The order cannot be assigned", [this] {
      assign(core::StudyStore(folder_->folder, core::StudyStore::Mode::kReadOnly));
    });
  } else if (result.tab != StudyTab::kNone) {
    preflight_.reset();
    go_to(result.tab);
  }
}

void Application::show_results() {
  screen_ = Screen::kResults;
  reload_folder();
  results_task_ = std::make_unique<BackgroundTask<ResultsModel>>(
      [folder = folder_->folder](WorkControl& control) {
        return results_model(folder, control);
      },
      wake_);
}

void Application::draw_results(Ui& ui) {
  ResultsViewModel model{.study = *folder_,
                         .results = results_task_->result(),
                         .progress = results_task_->progress(),
                         .problem = results_task_->error(),
                         .is_blinded = folder_->hides_levels,
                         .work = study_work()};
  const ResultsViewResult result = draw_results_view(ui, model, results_state_);
  const fs::path folder = folder_->folder;
  if (result.cancel && work_) work_->cancel();
  if (result.export_tables) {
    begin_work("Exporting", [folder](WorkControl& control) {
      return export_tables(folder, free_folder_beside(folder, "csv"), control);
    });
  } else if (result.write_report) {
    begin_work("Writing the report", [folder](WorkControl& control) {
      return write_report(folder, free_folder_beside(folder, "report"), control);
    });
  } else if (result.save_picture) {
    picture_ = free_picture_beside(folder);
  } else if (result.unblind) {
    attempt("The study cannot be unblinded",
            [&] { outcome_ = unblind_study(folder, results_state_.reason); });
    if (message_.empty()) show_results();
  } else {
    go_to(result.tab);
  }
}

void Application::show_study() {
  if (watch_ == nullptr && folder_) {
    const fs::path file = folder_->study_file;
    if (file.empty() || !fs::exists(file)) {
      throw core::Error(folder_->folder.string() +
                        ": expected its study file, found that it is not where it was; open "
                        "the file itself");
    }
    watch_ = std::make_unique<StudyWatch>(file, !folder_->hides_levels);
  }
  screen_ = Screen::kStudy;
  reloaded_s_ = age_shown_s_ = now_s();
  orders_.clear();
  orders_problem_ = "";
  if (!watch_->study()) return;
  try {
    OrdersRequest request{.num_participants = study_state_.num_participants};
    if (folder_) {
      request.folder = folder_->folder;
      const core::StudyStore store(folder_->folder, core::StudyStore::Mode::kReadOnly);
      request.seed = seed_of(store);
    }
    orders_ = planned_orders(*watch_->study(), request);
    if (orders_.empty()) orders_problem_ = "The study is double-blind: its orders are hidden.";
  } catch (const core::Error& error) {
    orders_problem_ = error.what();
  }
}

bool Application::look_beside() {
  if (screen_ != Screen::kStudy || watch_ == nullptr) return false;
  const double now = now_s();
  if (watch_->look(now)) {
    show_study();
    return true;
  }
  // How long ago that was: in seconds, then in minutes.
  if (watch_->num_reloads() == 0 || now < age_shown_s_ + (now < reloaded_s_ + 60 ? 1 : 60)) {
    return false;
  }
  age_shown_s_ = now;
  return true;
}

void Application::draw_study(Ui& ui) {
  const StudyViewResult result = draw_study_view(ui,
                                                 {.study = folder_ ? &*folder_ : nullptr,
                                                  .outline = watch_->outline(),
                                                  .orders = orders_,
                                                  .orders_problem = orders_problem_,
                                                  .num_reloads = watch_->num_reloads(),
                                                  .since_reload_s = now_s() - reloaded_s_},
                                                 study_state_);
  if (result.orders_changed) show_study();
  if (result.tab != StudyTab::kNone) watch_ = folder_ ? std::move(watch_) : nullptr;
  go_to(result.tab);
}

// Work beside the window.

void Application::begin_work(const char* name,
                             std::function<ActionOutcome(WorkControl&)> work) {
  if (work_ && work_->running()) return;
  work_name_ = name;
  outcome_ = {};
  work_ = std::make_unique<BackgroundTask<ActionOutcome>>(std::move(work), wake_);
}

StudyWork Application::study_work() const {
  return {.running = work_ ? work_name_ : "",
          .progress = work_ ? work_->progress() : 0.0,
          .outcome = outcome_};
}

void Application::collect_work() {
  if (!work_ || work_->running()) return;
  if (work_->result() != nullptr) {
    outcome_ = *work_->result();
  } else {
    outcome_ = {.ok = false,
                .sentence = work_->status() == WorkStatus::kCancelled
                                ? work_name_ + ": cancelled"
                                : work_->error()};
  }
  work_.reset();
  attempt("The study cannot be read", [this] { reload_folder(); });
}

// What stands on every view.

void Application::draw_corner(Ui& ui) {
  Rect strip = ui.screen().take_bottom(40);
  strip.take_right(12);
  struct Corner {
    const char *name, *label;
    Chord key;
    std::function<void()> act;
  };
  std::vector<Corner> corners = {
      {"keys", "All keys", {Key::kF1}, [this] { shows_keys_ = true; }}};
  if (screen_ != Screen::kSession) {
    corners.push_back({"larger", "Larger", {Key::kPlus, true}, [&] { zoom_ *= kZoomStep; }});
    corners.push_back({"dark", ui.theme().dark() ? "Light" : "Dark", {letter('D'), true}, [&] {
                         ui.theme().set_dark(!ui.theme().dark());
                       }});
  }
  for (const Corner& corner : corners) {
    const ButtonStyle style{.tone = Tone::kQuiet, .key = corner.key};
    const Rect place = strip.take_right(ui.button_width(corner.label, style), 2);
    if (ui.button(corner.name, place.middle(place.width, 32), corner.label, style)) {
      corner.act();
    }
  }
}

void Application::take_global_keys(Ui& ui) {
  // Of other screens the buttons in the corner have these two.
  if (screen_ == Screen::kSession) {
    if (ui.pressed({letter('D'), true})) ui.theme().set_dark(!ui.theme().dark());
    if (ui.pressed({Key::kPlus, true})) zoom_ *= kZoomStep;
  }
  if (ui.pressed({Key::kMinus, true})) zoom_ /= kZoomStep;
  zoom_ = std::clamp(zoom_, 0.5f, 2.0f);
  if (ui.pressed({Key::kF9})) shows_participant_ = !shows_participant_;
  if (ui.pressed({letter('Q'), true})) ask_to_close();
}

void Application::draw_message(Ui& ui) {
  const TextStyle style{.wrap = true};
  const float height = ui.text_height(560, message_, style);
  Rect inside = ui.begin_dialog("message", 620, 150 + std::min(height, 400.0f));
  ui.text(inside.take_top(34, 6), message_title_, {.font = Font::kLarge});
  const ButtonStyle close{.tone = Tone::kPrimary, .key = {Key::kEnter}};
  Rect row = inside.take_bottom(44, 8);
  ui.text(inside, message_, style);
  if (ui.button("message_close", row.take_right(ui.button_width("Close", close)), "Close",
                close)) {
    message_.clear();
  }
  ui.end_dialog();
}

}  // namespace jnd::app::gui
