#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "app/gui/application/open_study.h"
#include "app/gui/application/screen.h"
#include "app/gui/views/apparatus_view.h"
#include "app/gui/views/run_view.h"
#include "app/operator/answer_controls.h"
#include "app/operator/background_task.h"
#include "app/operator/session_worker.h"
#include "app/session/operator_exchange.h"

namespace jnd::app::gui {

/// A session in the window, from its start or resumption to the check and backup after it.
class SessionScreen final : public Screen {
 public:
  /// `device_profile` is the profile's file for resumed sessions; if "", one is looked for.
  /// `streams` and `markers` connect every session to other recorders. `sound_output` is that
  /// of resumed sessions. `simulated_clock_s` is as in `WindowRequest`.
  SessionScreen(ScreenHost& host, OpenStudy& study, bool allow_no_realtime,
                std::string device_profile, WantedStreams streams, WantedMarkers markers,
                AnswerControls& controls, std::string sound_output,
                std::function<double()> simulated_clock_s)
      : host_(host),
        study_(study),
        allow_no_realtime_(allow_no_realtime),
        device_profile_(std::move(device_profile)),
        streams_(std::move(streams)),
        markers_(std::move(markers)),
        controls_(controls),
        sound_output_(std::move(sound_output)),
        simulated_clock_s_(std::move(simulated_clock_s)) {}
  ~SessionScreen() override { controls_.end_session(); }
  SessionScreen(const SessionScreen&) = delete;
  SessionScreen& operator=(const SessionScreen&) = delete;

  /// Adds a session to the study that is open, and begins it. Throws `Error`.
  void start(const NewSession& session);
  /// Resumes a session of the study that is open. Throws `Error`.
  void resume(std::int64_t session);

  [[nodiscard]] const char* name() const noexcept override {
    return run_state_.shows_apparatus ? "apparatus" : "session";
  }
  [[nodiscard]] const char* manual_page() const noexcept override {
    return run_state_.shows_apparatus ? "docs/apparatus.md" : "docs/how-to/run_a_session.md";
  }
  void show() override {}
  void update(Ui& ui) override;
  void draw(Ui& ui) override;
  [[nodiscard]] bool works() const noexcept override;

  /// True while a session is under way.
  [[nodiscard]] bool is_live() const noexcept { return worker_ != nullptr; }
  /// The newest picture of the session; nullptr before the first one.
  [[nodiscard]] const SessionView* view() const noexcept { return view_.get(); }
  /// What the operator is typing as the answer now, for the participant to see; "" if nothing.
  [[nodiscard]] std::string typed_answer() const;
  /// Tells that something lies over the screen and takes what is typed.
  void set_covered(bool is_covered) noexcept { run_state_.is_covered = is_covered; }
  [[nodiscard]] bool is_covered() const noexcept { return run_state_.is_covered; }

  // These come directly from the window's events, without any queue.
  void press_stop() noexcept { exchange_.emergency_stop.press(); }
  [[nodiscard]] bool stop_is_pressed() const noexcept {
    return exchange_.emergency_stop.is_pressed();
  }
  void beat(bool is_in_sight) noexcept { exchange_.beat(is_in_sight); }
  /// The mouse's place, which moves the hand on the pad; logical pixels.
  void cursor(float x, float y) noexcept;

  /// Asks the person whether to leave; the window closes once the session is left.
  void ask_to_close();
  /// Leaves the session as it is, to be resumed; then the window closes.
  void leave_and_close(const std::string& reason);

  /// Draws the apparatus, where the machine can. The view shows the message of what it throws
  /// in the picture's place.
  std::function<std::uintptr_t(const SceneRequest&)> paint_scene;

 private:
  void run(std::unique_ptr<core::StudyStore> store, std::int64_t session,
           const std::string& language, const std::string& sound_output,
           const std::map<std::string, std::string>& fitting = {});
  void hold_input(Ui& ui, bool is_behind, bool requests_wait) const;
  [[nodiscard]] RunViewResult draw_session_view(Ui& ui);
  [[nodiscard]] ApparatusSources apparatus_sources();
  void close_session();
  void after_session();
  void begin_backup(const std::filesystem::path& target);

  ScreenHost& host_;
  OpenStudy& study_;
  bool allow_no_realtime_;
  std::string device_profile_;
  WantedStreams streams_;
  WantedMarkers markers_;
  AnswerControls& controls_;
  std::string sound_output_;
  std::function<double()> simulated_clock_s_;
  OperatorExchange exchange_;
  std::unique_ptr<SessionWorker> worker_;
  std::shared_ptr<const SessionView> view_;
  /// When the operator last requested something.
  std::chrono::steady_clock::time_point requested_at_;
  std::filesystem::path folder_;  ///< The folder of the session's study.
  RunViewState run_state_;
  ApparatusViewState apparatus_state_;
  std::string paint_problem_;
  AfterSession after_;
  std::unique_ptr<BackgroundTask<ActionOutcome>> check_, backup_;
  bool finished_ = false;
  bool closing_ = false, leaving_ = false;
  std::uint64_t pointer_sequence_ = 0;
};

}  // namespace jnd::app::gui
