#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/gui/ui.h"
#include "app/gui/views/study_tabs.h"

namespace jnd::app {
struct WindowRequest;
}

namespace jnd::app::gui {

class OpenStudy;
class ScreenHost;

/// One screen of the window: what it shows, kept while others stand there, and what the
/// requests of its view do. One thread, that of the window.
class Screen {
 public:
  virtual ~Screen() = default;
  /// "sessions": as tabs and the log of widgets have it.
  [[nodiscard]] virtual const char* name() const noexcept = 0;
  /// The page of the manual about it, "docs/how-to/run_a_session.md".
  [[nodiscard]] virtual const char* manual_page() const noexcept = 0;
  /// Called before it comes to stand in the window. What it throws keeps it from that.
  virtual void show() = 0;
  /// Takes what has come from other threads, before anything is drawn; may go to another one.
  virtual void update(Ui&) {}
  virtual void draw(Ui& ui) = 0;
  /// Looks at what changes beside the window, once a second or more often. True if a frame
  /// should show it.
  [[nodiscard]] virtual bool look_beside() { return false; }
  /// Something goes on beside the window that a frame shows.
  [[nodiscard]] virtual bool works() const noexcept { return false; }
  /// Another study was opened: nothing of the last one is kept.
  virtual void forget_study() {}
};

/// What a screen is made of. All of it outlives the screen.
struct ScreenParts {
  ScreenHost& host;
  OpenStudy& study;
  const WindowRequest& request;  ///< What the command line asks for.
};

/// Every screen that has in its file a function
///     std::unique_ptr<Screen> make_NAME_screen(const ScreenParts& parts);
/// where the build finds it. The others are members of `Application`, which tells them more.
[[nodiscard]] std::vector<std::unique_ptr<Screen>> make_screens(const ScreenParts& parts);

/// A session to be begun in the study that is open.
struct NewSession {
  std::string participant, device;
  std::string device_profile;  ///< A file; "": a real device's own is looked for.
  std::uint64_t seed = 0;      ///< Of the study.
  bool pilot = false;
  std::string language;
  std::map<std::string, std::string> fields;   ///< What the participant brings.
  std::map<std::string, std::string> fitting;  ///< How the device was fitted to them.
  std::string sound_output;                    ///< As `SoundChoice::output`.
};

/// What a screen asks of the window around it.
class ScreenHost {
 public:
  virtual ~ScreenHost() = default;
  [[nodiscard]] virtual bool shows(const Screen& screen) const noexcept = 0;
  /// Another screen, at once; why it cannot be opened is told. Nothing for `kNone`.
  virtual void go_to(StudyTab tab) = 0;
  /// The screen before a session, of this participant, or of whoever comes next where it is
  /// "". Throws what keeps it from opening.
  virtual void prepare_session(const std::string& participant) = 0;
  /// The page of a stored session. Throws what keeps it from opening.
  virtual void show_session(std::int64_t session) = 0;
  /// A study file, or the folder of a study. Throws `Error`.
  virtual void open(const std::filesystem::path& path) = 0;
  virtual void start_session(const NewSession& session) = 0;
  virtual void resume_session(const std::filesystem::path& folder, std::int64_t session) = 0;
  /// Runs `work`, and tells what goes wrong; false then.
  virtual bool attempt(const char* title, const std::function<void()>& work) = 0;
  virtual void tell(const std::string& title, const std::string& sentence) = 0;
  virtual void close() = 0;
  /// Draws another frame; called from any thread.
  [[nodiscard]] virtual std::function<void()> wake() const = 0;
};

}  // namespace jnd::app::gui
