#include "app/window/window_driver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <csignal>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <thread>

// This include comes last, because its macros are called None and Bool.
#include <X11/Xlib.h>

namespace jnd::app {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// A long time, because the processor draws the window beside another test. No test sleeps
// through it.
constexpr auto kPatience = std::chrono::seconds(30);
constexpr auto kGlance = std::chrono::milliseconds(5);

/// For xdotool, "Ctrl Z" is ctrl+z.
std::string xdotool_words(const std::string& printed) {
  static const std::map<std::string, std::string> kNames = {
      {"Ctrl", "ctrl"},  {"Shift", "shift"},  {"Space", "space"},
      {"Esc", "Escape"}, {"Enter", "Return"}, {"Backspace", "BackSpace"},
      {"Del", "Delete"}, {"←", "Left"},       {"→", "Right"},
      {"↑", "Up"},       {"↓", "Down"},       {"+", "plus"},
      {"-", "minus"},    {".", "period"}};
  std::istringstream words(printed);
  std::string keys;
  for (std::string word; words >> word;) {
    const auto known = kNames.find(word);
    if (known != kNames.end()) word = known->second;
    if (word.size() == 1) word[0] = static_cast<char>(std::tolower(word[0]));
    keys += (keys.empty() ? "" : "+") + word;
  }
  return keys;
}

std::string seconds(std::chrono::milliseconds duration) {
  return std::to_string(static_cast<double>(duration.count()) / 1000.0);
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

WindowDriver::WindowDriver(VirtualDisplay& display, fs::path folder)
    : display_(display), folder_(std::move(folder)) {
  fs::create_directories(folder_);
}

WindowDriver::~WindowDriver() = default;

std::vector<std::pair<std::string, std::string>> WindowDriver::environment() const {
  std::vector<std::pair<std::string, std::string>> variables = {
      {"HOME", folder_.string()},
      {"XDG_STATE_HOME", (folder_ / "state").string()},
      {"XDG_DATA_HOME", (folder_ / "data").string()}};
  if (!share.empty()) variables.emplace_back("JND_SHARE", share.string());
  return variables;
}

void WindowDriver::start(const std::vector<std::string>& arguments) {
  fs::remove(folder_ / "widgets.json");
  window_.clear();
  test_support::ProgramOptions options{.folder = folder_, .environment = environment()};
  options.environment.emplace_back("DISPLAY", display_.name());
  options.environment.emplace_back("LIBGL_ALWAYS_SOFTWARE", "1");
  options.environment.emplace_back("JND_WIDGETS", (folder_ / "widgets.json").string());
  program_ = std::make_unique<test_support::RunningProgram>(arguments, options);
  wait_until("a window", [](const Screen& now) { return now.frame > 0; });
}

void WindowDriver::kill() {
  program_->send_signal(SIGKILL);
  (void)wait_for_exit();
}

test_support::ProgramOutcome WindowDriver::wait_for_exit() {
  const auto end = Clock::now() + kPatience;
  while (!program_->has_ended()) {
    if (Clock::now() > end) {
      throw std::runtime_error("the program does not end" + stands_there(screen()));
    }
    std::this_thread::sleep_for(kGlance);
  }
  test_support::ProgramOutcome outcome = program_->wait();
  program_.reset();
  return outcome;
}

// Reading the screen.

Screen WindowDriver::screen() const { return read_screen(folder_ / "widgets.json"); }

Screen WindowDriver::wait_until(const std::string& what, const Condition& condition) const {
  const auto end = Clock::now() + kPatience;
  Screen now = screen();
  // A dialog that questions an answer covers whatever the test waits for.
  const auto is_asked = [this](const Screen& at) {
    return confirms_answers && at.offers("doubt_store");
  };
  while (is_asked(now) || !condition(now)) {
    const bool has_ended = program_ == nullptr || program_->has_ended();
    if (has_ended || Clock::now() > end) {
      const std::string why = has_ended ? "the program ended before " : "waited in vain for ";
      throw std::runtime_error(why + what + stands_there(now));
    }
    if (is_asked(now)) {
      press("s");
      // The key is pressed once for each dialog, because the next card may have the same key.
      while (screen().offers("doubt_store") && Clock::now() < end) {
        std::this_thread::sleep_for(kGlance);
      }
    }
    std::this_thread::sleep_for(kGlance);
    now = screen();
    if (forgives_stalls && now.offers("rearm") && now.shows("program stopped answering")) {
      press("ctrl+Return");
    }
  }
  return now;
}

Screen WindowDriver::wait_for(const std::string& widget) const {
  return wait_until("the widget " + widget,
                    [&](const Screen& now) { return now.offers(widget); });
}

Screen WindowDriver::wait_for_text(const std::string& part) const {
  return wait_until("the words \"" + part + "\"",
                    [&](const Screen& now) { return now.shows(part); });
}

Screen WindowDriver::wait_for_view(const std::string& view) const {
  return wait_until("the view " + view, [&](const Screen& now) { return now.view == view; });
}

std::string WindowDriver::every_text() const {
  std::ifstream stream(folder_ / "widgets.json.texts", std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string WindowDriver::stands_there(const Screen& screen) const {
  if (program_ != nullptr && program_->has_ended()) {
    const test_support::ProgramOutcome outcome = program_->wait();
    return " with exit code " + std::to_string(outcome.exit_code) + ", signal " +
           std::to_string(outcome.signal) + ": " + outcome.err;
  }
  std::string words = "; " + described(screen);
  // There is no test when a bench runs.
  const ::testing::TestInfo* test = ::testing::UnitTest::GetInstance()->current_test_info();
  const fs::path file = fs::path(JND_WINDOW_FAILURES) /
                        (std::string(test == nullptr ? "measurement" : test->name()) + ".png");
  fs::create_directories(file.parent_path());
  const std::vector<std::string> take = {"import", "-window", "root", file.string()};
  if (run_tool(take, display_.name()).exit_code == 0) words += "a picture: " + file.string();
  return words;
}

void WindowDriver::picture(const fs::path& file, const std::string& title) const {
  fs::create_directories(file.parent_path());
  const std::string number = title == "jnd" ? window() : find_window(title);
  const std::vector<std::string> take = {
      "import", "-window", number, "-define", "png:compression-level=3", file.string()};
  if (run_tool(take, display_.name()).exit_code != 0) {
    throw std::runtime_error("no picture: " + file.string());
  }
}

bool WindowDriver::is_dark() const {
  const auto end = Clock::now() + kPatience;
  while (Clock::now() < end) {
    const ToolOutcome pixel = run_tool({"import", "-window", window(), "-gravity", "SouthWest",
                                        "-crop", "1x1+12+12", "-depth", "8", "gray:-"},
                                       display_.name());
    // An area that has grown and is not drawn yet is black, and nothing of ours is quite black.
    if (pixel.out.size() != 1 || pixel.out[0] == 0) continue;
    constexpr unsigned char kMiddle = 70;  // Below a dialog, the light theme is half as light.
    return static_cast<unsigned char>(pixel.out[0]) < kMiddle;
  }
  throw std::runtime_error("no pixel of the window can be seen");
}

std::string WindowDriver::find_window(const std::string& title) const {
  return first_line(
      run_tool({"xdotool", "search", "--onlyvisible", "--name", "^" + title + "$"},
               display_.name())
          .out);
}

bool WindowDriver::has_window(const std::string& title) const {
  return !find_window(title).empty();
}

std::string WindowDriver::window() const {
  const auto end = Clock::now() + kPatience;
  while (window_.empty()) {
    window_ = find_window("jnd");
    if (Clock::now() > end) throw std::runtime_error("no window is called jnd");
  }
  return window_;
}

// Using keyboard and mouse.

void WindowDriver::xdotool(std::vector<std::string> words) const {
  words.insert(words.begin(), "xdotool");
  const ToolOutcome outcome = run_tool(words, display_.name());
  if (outcome.exit_code == 0) return;
  std::string all = std::to_string(outcome.exit_code) + " " + outcome.out + " ";
  for (const std::string& word : words) all += word + " ";
  throw std::runtime_error("refused: " + all + stands_there(screen()));
}

void WindowDriver::press_at_once(std::initializer_list<std::string> keys) const {
  // GLFW ignores a key that goes down twice in one millisecond, because it takes it for an echo
  // of the input method.
  std::vector<std::string> words = {"key", "--delay", "4"};
  words.insert(words.end(), keys.begin(), keys.end());
  xdotool(words);
}

void WindowDriver::hold(const std::string& key, std::chrono::milliseconds duration) const {
  xdotool({"keydown", key, "sleep", seconds(duration), "keyup", key});
}

void WindowDriver::type(const std::string& text) const {
  xdotool({"type", "--delay", "1", text});
}

void WindowDriver::click(const std::string& widget) const {
  hold_button(widget, std::chrono::milliseconds(0));
}

void WindowDriver::hold_button(const std::string& widget,
                               std::chrono::milliseconds duration) const {
  const Screen now = wait_for(widget);
  const Screen::Widget& place = *now.find(widget);
  xdotool({"mousemove", "--window", window(), std::to_string(place.x + place.width / 2),
           std::to_string(place.y + place.height / 2), "mousedown", "1", "sleep",
           seconds(duration), "mouseup", "1"});
}

void WindowDriver::use(const std::string& widget) const {
  const Screen now = wait_for(widget);
  const std::string key = xdotool_words(now.find(widget)->key);
  if (hand == Hand::kMouse || key.empty()) {
    click(widget);
  } else {
    press(key);
  }
}

void WindowDriver::move_hand(int num_strokes) const {
  const Screen now = wait_until("the pad", [](const Screen& at) { return at.offers("pad"); });
  const Screen::Widget& pad = *now.find("pad");
  constexpr int kSteps = 24;  // Steps of a stroke of a third of a second.
  std::vector<std::string> words;
  for (int step = 0; step <= num_strokes * kSteps; ++step) {
    const int along = step % (2 * kSteps);
    const int x = pad.x + pad.width / 4 +
                  pad.width / 2 * (along <= kSteps ? along : 2 * kSteps - along) / kSteps;
    for (const std::string& word :
         {std::string("mousemove"), std::string("--window"), window(), std::to_string(x),
          std::to_string(pad.y + pad.height / 2), std::string("sleep"), std::string("0.014")}) {
      words.push_back(word);
    }
  }
  xdotool(words);
}

/// Sends what a window manager would send; there is none on this display.
void WindowDriver::press_close_button() const {
  const std::string number = window();
  Display* display = ::XOpenDisplay(display_.name().c_str());
  if (display == nullptr) throw std::runtime_error("no display " + display_.name());
  XEvent event{};
  event.xclient.type = ClientMessage;
  event.xclient.window = std::stoul(number);
  event.xclient.message_type = ::XInternAtom(display, "WM_PROTOCOLS", False);
  event.xclient.format = 32;
  event.xclient.data.l[0] =
      static_cast<long>(::XInternAtom(display, "WM_DELETE_WINDOW", False));
  event.xclient.data.l[1] = CurrentTime;
  ::XSendEvent(display, event.xclient.window, False, NoEventMask, &event);
  ::XCloseDisplay(display);
}

void WindowDriver::resize(int width_px, int height_px) const {
  xdotool({"windowsize", window(), std::to_string(width_px), std::to_string(height_px)});
  // In every view some button is in the lower right corner.
  wait_until("the new size", [&](const Screen& now) {
    const Screen::Widget* corner = now.find("keys");
    return corner != nullptr && std::abs(corner->x + corner->width - width_px) < 40 &&
           std::abs(corner->y + corner->height - height_px) < 40;
  });
}

}  // namespace jnd::app
