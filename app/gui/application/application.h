#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/command_line/open_window.h"
#include "app/gui/participant_stop.h"
#include "app/gui/ui.h"
#include "app/gui/views/apparatus_view.h"
#include "app/gui/views/prepare_view.h"
#include "app/gui/views/results_view.h"
#include "app/gui/views/run_view.h"
#include "app/gui/views/sessions_view.h"
#include "app/gui/views/start_view.h"
#include "app/gui/views/study_view.h"
#include "app/operator/background_task.h"
#include "app/operator/export_actions.h"
#include "app/operator/preflight.h"
#include "app/operator/recent_studies.h"
#include "app/operator/session_worker.h"
#include "app/operator/study_folder.h"
#include "app/operator/study_outline.h"
#include "app/session/operator_exchange.h"

namespace jnd::app::gui {

/// Everything in the window but its pixels: which view stands, what it shows, and what its
/// requests do. One thread, that of the window; long work goes on beside it.
class Application {
 public:
  /// `wake` draws another frame; called from any thread.
  Application(WindowRequest request, std::function<void()> wake);
  ~Application();
  Application(const Application&) = delete;
  Application& operator=(const Application&) = delete;

  void draw(Ui& ui);
  void draw_participant(Ui& ui);
  /// Draws the apparatus, where somebody can; what it throws is told in its place.
  std::function<std::uintptr_t(const SceneRequest&)> paint_scene;

  // What the window asks and tells.
  [[nodiscard]] const char* view_name() const noexcept;
  /// A session is under way: frames at the pace of its pictures, and a heartbeat.
  [[nodiscard]] bool is_live() const noexcept { return worker_ != nullptr; }
  [[nodiscard]] bool works() const noexcept;
  /// Looks at what changes beside the window, the file of the study on screen: once a second
  /// or more often. True if a frame should show it.
  [[nodiscard]] bool look_beside();
  [[nodiscard]] bool shows_participant() const noexcept { return shows_participant_; }
  void hide_participant() noexcept { shows_participant_ = false; }
  [[nodiscard]] bool closed() const noexcept { return closed_; }
  /// What the person chose on top of the monitor's scale.
  [[nodiscard]] float zoom() const noexcept { return zoom_; }
  /// Where the next frame shall be saved as a picture; once.
  [[nodiscard]] std::optional<std::filesystem::path> take_picture_request();
  /// What came of it; `problem` is "" if nothing went wrong.
  void picture_saved(const std::filesystem::path& file, const std::string& problem);

  /// The emergency stop; past everything else.
  void escape() noexcept;
  /// A key went down or up: it may be the participant's stop. Past everything else as well.
  void key_changed(Key key, bool is_down) noexcept;
  /// The mouse went down there, logical pixels: the stop does not wait for a frame either.
  void mouse_pressed(float x, float y) noexcept;
  /// The system asks the program to end: a session is left as it is, to be resumed.
  void end_soon();
  void beat() noexcept {
    keep_stopped();
    exchange_.heartbeat.beat();
  }
  /// Of the mouse, logical pixels, whenever it moves.
  void cursor(float x, float y) noexcept;
  /// The close button: asks first where a session goes on.
  void ask_to_close();

 private:
  void keep_stopped() noexcept;

  enum class Screen { kStart, kPrepare, kSession, kSessions, kResults, kStudy };

  void draw_start(Ui& ui);
  void draw_prepare(Ui& ui);
  void draw_session(Ui& ui);
  [[nodiscard]] RunViewResult draw_session_view(Ui& ui);
  [[nodiscard]] ApparatusSources apparatus_sources();
  void draw_sessions(Ui& ui);
  void draw_results(Ui& ui);
  void draw_study(Ui& ui);
  void draw_corner(Ui& ui);
  void draw_message(Ui& ui);
  void take_global_keys(Ui& ui);

  void go_to(StudyTab tab);
  void show_start();
  void show_sessions();
  void show_prepare();
  void show_results();
  void show_study();
  void tell(const std::string& title, const std::string& sentence);
  /// Runs `work`, and tells what goes wrong.
  void attempt(const char* title, const std::function<void()>& work);

  void open(const std::filesystem::path& path);
  void open_folder(const std::filesystem::path& folder);
  void reload_folder();
  /// Says in words which cell comes next, once what the participant brings is known.
  void assign(const core::StudyStore& store);
  void look_before();
  void start_tour();
  void start_session(const std::string& participant, const std::string& device);
  void resume_session(const std::filesystem::path& folder, std::int64_t session);
  void run(std::unique_ptr<core::StudyStore> store, std::int64_t session);
  void hold_input(Ui& ui, bool is_behind, bool requests_wait) const;
  void after_session();
  void close_session();
  void begin_work(const char* name, std::function<ActionOutcome(WorkControl&)> work);
  [[nodiscard]] StudyWork study_work() const;
  void collect_work();

  WindowRequest request_;
  std::function<void()> wake_;
  RecentStudies recent_;
  OperatorExchange exchange_;
  ParticipantStop participant_stop_;
  Screen screen_ = Screen::kStart;
  bool closed_ = false, closing_ = false, leaving_ = false;
  bool shows_participant_ = false;
  bool shows_keys_ = false;
  float zoom_ = 1.0f;
  std::string message_title_, message_;
  std::optional<std::filesystem::path> picture_;

  StartModel start_;
  std::unique_ptr<BackgroundTask<StartModel>> start_task_;
  StartViewState start_state_;

  std::optional<StudyFolder> folder_;
  std::optional<experiments::Study> study_;  ///< Of the folder.
  PrepareViewState prepare_state_;
  std::vector<PrepareModel::Device> devices_;
  std::unique_ptr<Preflight> preflight_;
  std::vector<std::string> taken_;
  std::string assigned_;
  std::uint64_t seed_ = 0;

  std::unique_ptr<SessionWorker> worker_;
  std::shared_ptr<const SessionView> view_;
  std::chrono::steady_clock::time_point requested_at_;  ///< The last time.
  std::filesystem::path session_folder_;
  Rect stop_place_;  ///< Of the stop's button in the last frame; empty without.
  RunViewState run_state_;
  ApparatusViewState apparatus_state_;
  std::string paint_problem_;
  AfterSession after_;
  std::unique_ptr<BackgroundTask<ActionOutcome>> check_, backup_;
  bool finished_ = false;
  std::uint64_t pointer_sequence_ = 0;

  SessionsViewState sessions_state_;
  std::string work_name_;
  std::unique_ptr<BackgroundTask<ActionOutcome>> work_;
  ActionOutcome outcome_;

  std::unique_ptr<BackgroundTask<ResultsModel>> results_task_;
  ResultsViewState results_state_;

  std::unique_ptr<StudyWatch> watch_;
  std::vector<PlannedOrder> orders_;
  std::string orders_problem_;
  StudyViewState study_state_;
  double reloaded_s_ = 0.0, age_shown_s_ = 0.0;
  std::vector<Drawn::Widget> last_widgets_;
};

}  // namespace jnd::app::gui
