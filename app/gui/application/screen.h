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
  /// Takes results from other threads before anything is drawn; it may switch to another
  /// screen.
  virtual void update(Ui&) {}
  virtual void draw(Ui& ui) = 0;
  /// Looks at what changes outside the window, such as files; called once a second or more
  /// often. Returns true if a frame should show a change.
  [[nodiscard]] virtual bool look_beside() { return false; }
  /// True while something that a frame shows goes on in the background.
  [[nodiscard]] virtual bool works() const noexcept { return false; }
  /// Another study was opened: the screen forgets everything about the previous one.
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
  /// The profile's file; if "", a real device's own profile is looked for.
  std::string device_profile;
  std::uint64_t seed = 0;  ///< The seed of the study.
  bool pilot = false;
  std::string language;
  /// What the study asks about the participant, by field.
  std::map<std::string, std::string> fields;
  /// How the device was fitted to the participant.
  std::map<std::string, std::string> fitting;
  std::string sound_output;  ///< The sound output, as in `SoundChoice::output`.
};

/// What a screen asks of the window around it.
class ScreenHost {
 public:
  virtual ~ScreenHost() = default;
  [[nodiscard]] virtual bool shows(const Screen& screen) const noexcept = 0;
  /// Shows another screen at once, or tells why it cannot be opened, for example because no
  /// screen has this name. Does nothing for `kNone`.
  virtual void go_to(StudyTab tab) = 0;
  /// Shows the screen before a session of this participant; "" stands for whoever comes next.
  /// Throws the reason if that screen cannot open.
  virtual void prepare_session(const std::string& participant) = 0;
  /// Shows the page of a stored session. Throws the reason if it cannot open.
  virtual void show_session(std::int64_t session) = 0;
  /// Opens a study file or the folder of a study. Throws `Error`.
  virtual void open(const std::filesystem::path& path) = 0;
  virtual void start_session(const NewSession& session) = 0;
  virtual void resume_session(const std::filesystem::path& folder, std::int64_t session) = 0;
  /// Runs `work`. If it throws, tells what went wrong and returns false.
  virtual bool attempt(const char* title, const std::function<void()>& work) = 0;
  virtual void tell(const std::string& title, const std::string& sentence) = 0;
  virtual void close() = 0;
  /// A function that requests another frame; any thread may call it.
  [[nodiscard]] virtual std::function<void()> wake() const = 0;
};

}  // namespace jnd::app::gui
