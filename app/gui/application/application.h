#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/command_line/open_window.h"
#include "app/gui/application/data_screen.h"
#include "app/gui/application/device_screen.h"
#include "app/gui/application/open_study.h"
#include "app/gui/application/prepare_screen.h"
#include "app/gui/application/record_screen.h"
#include "app/gui/application/screen.h"
#include "app/gui/application/session_screen.h"
#include "app/gui/application/start_screen.h"
#include "app/gui/application/study_screen.h"
#include "app/gui/participant_stop.h"
#include "app/gui/ui.h"
#include "app/gui/views/participant_view.h"
#include "app/language/words.h"
#include "app/operator/answer_controls.h"
#include "app/operator/participant_place.h"
#include "app/operator/recent_studies.h"

namespace jnd::app::gui {

/// Everything in the window except its pixels: the screens, which of them is shown, and what
/// appears on all of them. Only the window's thread uses it; long work runs beside it in the
/// background.
class Application final : private ScreenHost {
 public:
  /// `wake` requests another frame; any thread may call it.
  Application(WindowRequest request, std::function<void()> wake);
  Application(const Application&) = delete;
  Application& operator=(const Application&) = delete;

  void draw(Ui& ui);
  void draw_participant(Ui& ui);
  void set_scene_painter(std::function<std::uintptr_t(const SceneRequest&)> paint) {
    session_.paint_scene = std::move(paint);
  }

  // What the window asks of the application and tells it.
  [[nodiscard]] const char* view_name() const noexcept { return screen_->name(); }
  /// True while a session is under way or a device may move. The window then draws frames at
  /// the pace of the session's pictures and sends a heartbeat.
  [[nodiscard]] bool is_live() const noexcept {
    return session_.is_live() || device_.is_live();
  }
  [[nodiscard]] bool works() const noexcept;
  /// Looks at what changes outside the window, such as files; called once a second or more
  /// often. Returns true if a frame should show a change.
  [[nodiscard]] bool look_beside() { return screen_->look_beside(); }
  /// Takes the monitors that are plugged in; the window calls it before each frame.
  void set_monitors(const std::vector<Monitor>& monitors) { monitors_ = monitors; }
  /// Where the participant's screen has to be shown now.
  [[nodiscard]] const ScreenPlace& participant_place() const noexcept {
    return participant_place_;
  }
  /// Somebody closed the participant's screen by its own close button. It stays closed until
  /// the next session, or until it is chosen again.
  void hide_participant() noexcept { shows_participant_ = false; }
  /// The participant's screen cannot be opened. The operator is told `why`, and the session
  /// goes on.
  void lose_participant(const std::string& why) {
    hide_participant();
    tell(tr("The participant's screen"), why);
  }
  [[nodiscard]] bool closed() const noexcept { return closed_; }
  /// The scale that the person chose in the window; it multiplies the monitor's own scale.
  [[nodiscard]] float zoom() const noexcept { return zoom_; }
  void set_zoom(float zoom) noexcept { zoom_ = zoom; }
  /// Sets the languages that the start screen offers; at first there are none.
  void offer(std::vector<Language> languages) { languages_ = std::move(languages); }
  /// The code of the language that somebody chose instead of the present one; the window begins
  /// anew in it. "" if nobody chose one.
  [[nodiscard]] const std::string& wanted_language() const noexcept { return wanted_language_; }

  /// Presses the emergency stop, without waiting for queued input or a frame.
  void escape() noexcept;
  /// Tells that a key went down or up: it may be the participant's stop. Like `escape`, it does
  /// not wait for queued input.
  void key_changed(Key key, bool is_down) noexcept;
  /// Tells that the mouse button went down at this place, in logical pixels. A click on the
  /// stop does not wait for a frame either.
  void mouse_pressed(float x, float y) noexcept;
  /// Opens a file or folder that somebody dropped on the window: a table of answers, or a
  /// study. Does nothing while a session or a device is live.
  void dropped(const std::filesystem::path& path);
  /// The system asks the program to end. A session is left as it is, to be resumed.
  void end_soon();
  /// `is_in_sight`: of the window, and so of its emergency stop.
  void beat(bool is_in_sight) noexcept {
    keep_stopped();
    session_.beat(is_in_sight);
    device_.beat(is_in_sight);
  }
  /// Tells the mouse's place in logical pixels, whenever it moves.
  void cursor(float x, float y) noexcept { session_.cursor(x, y); }
  /// Somebody pressed the close button. While a session goes on, the person is asked first.
  void ask_to_close();
  void go_to(StudyTab tab) override;

 private:
  // What screens ask of the window, see `ScreenHost`.
  [[nodiscard]] bool shows(const Screen& screen) const noexcept override {
    return screen_ == &screen;
  }
  void prepare_session(const std::string& participant) override {
    prepare_.propose(participant);
    show(prepare_);
  }
  void show_session(std::int64_t session) override {
    record_.choose(session);
    show(record_);
  }
  void open(const std::filesystem::path& path) override;
  void start_session(const NewSession& session) override;
  void resume_session(const std::filesystem::path& folder, std::int64_t session) override;
  bool attempt(const char* title, const std::function<void()>& work) override;
  void tell(const std::string& title, const std::string& sentence) override;
  void close() override { closed_ = true; }
  [[nodiscard]] std::function<void()> wake() const override { return wake_; }

  void show(Screen& screen);
  void show(StudyTab tab);
  void open_folder(const std::filesystem::path& folder);
  void open_file(const std::filesystem::path& file);
  void forget_study(const std::filesystem::path& next);
  void show_first();
  void keep_stopped() noexcept;
  void draw_corner(Ui& ui);
  void make_larger(const Ui& ui);
  [[nodiscard]] const Language* next_language() const;
  void draw_message(Ui& ui);
  void place_participant();
  void draw_screens(Ui& ui);
  void open_manual();
  void take_global_keys(Ui& ui);

  WindowRequest request_;
  std::function<void()> wake_;
  RecentStudies recent_;
  /// Declared before the screens that use it: the session's stop is pressed from here, and the
  /// session's destructor tells that the session has ended.
  AnswerControls controls_;
  OpenStudy study_;
  StartScreen start_;
  PrepareScreen prepare_;
  SessionScreen session_;
  RecordScreen record_;
  StudyScreen study_screen_;
  DeviceScreen device_;
  DataScreen data_;
  const std::vector<std::unique_ptr<Screen>> other_screens_;
  std::vector<Screen*> screens_ = {&start_,        &prepare_, &session_, &record_,
                                   &study_screen_, &device_,  &data_};  ///< And the others.
  Screen* screen_ = &start_;  ///< That stands in the window.

  ParticipantStop participant_stop_;
  /// Where the stop's button was in the last frame; empty if there was none.
  Rect stop_place_;
  bool closed_ = false;
  bool shows_keys_ = false;
  bool shows_screens_ = false;  ///< The dialog that chooses the participant's monitor is open.
  std::vector<Monitor> monitors_;
  ScreenChoice screen_choice_;
  /// The participant's screen is open, on the monitor that was chosen.
  bool shows_participant_ = false;
  /// A session has just begun, and its participant's screen was not opened yet.
  bool session_has_no_screen_ = false;
  ScreenPlace participant_place_;
  ParticipantViewState participant_state_;
  float zoom_ = 1.0f;
  std::vector<Language> languages_;
  std::string wanted_language_;
  std::string message_title_, message_;
  std::vector<Drawn::Widget> last_widgets_;
};

}  // namespace jnd::app::gui
