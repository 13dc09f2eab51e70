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

/// A session in the window, from its start or resumption to the check and copy after it.
class SessionScreen final : public Screen {
 public:
  /// `device_profile`: that of sessions that are resumed, a file; "": looked for. `streams`: to
  /// and of other recorders, of every session, as `markers`. `sound_output`: of those that are
  /// resumed. `simulated_clock_s`: as in `WindowRequest`.
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
  /// Goes on with one of that study. Throws `Error`.
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

  /// A session is under way.
  [[nodiscard]] bool is_live() const noexcept { return worker_ != nullptr; }
  /// The newest picture of it; nullptr before the first.
  [[nodiscard]] const SessionView* view() const noexcept { return view_.get(); }
  /// What is being typed as the answer to what waits for one, for the participant to see; ""
  /// for nothing.
  [[nodiscard]] std::string typed_answer() const;
  /// Something lies over it and takes what is typed.
  void set_covered(bool is_covered) noexcept { run_state_.is_covered = is_covered; }
  [[nodiscard]] bool is_covered() const noexcept { return run_state_.is_covered; }

  // From the window's own events, past every queue.
  void press_stop() noexcept { exchange_.emergency_stop.press(); }
  [[nodiscard]] bool stop_is_pressed() const noexcept {
    return exchange_.emergency_stop.is_pressed();
  }
  void beat(bool is_in_sight) noexcept { exchange_.beat(is_in_sight); }
  /// The mouse's place, which moves the hand on the pad; logical pixels.
  void cursor(float x, float y) noexcept;

  /// Asks the person whether to leave; the window closes once it is left.
  void ask_to_close();
  /// Leaves it as it is, to be resumed; the window closes then.
  void leave_and_close(const std::string& reason);

  /// Draws the apparatus, where somebody can; what it throws is told in its place.
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
  std::chrono::steady_clock::time_point requested_at_;  ///< The last time.
  std::filesystem::path folder_;                        ///< Of the session's study.
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
