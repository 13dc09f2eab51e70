#include "soak/person.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <thread>
#include <utility>

namespace jnd::soak {

namespace fs = std::filesystem;
using app::gui::Chord;
using app::gui::Drawn;
using app::gui::Key;
using app::gui::letter;
using app::gui::Ui;
using Clock = std::chrono::steady_clock;

namespace {

/// The window draws at this pace while something moves.
constexpr double kFrame_s = 1.0 / 30.0;
/// Real time between two looks at work beside the window.
constexpr auto kBetweenLooksAtWork = std::chrono::milliseconds(3);
constexpr int kFramesBetweenLooksBeside = 30;
/// Real time, in which a device without a session runs.
constexpr double kWatched_s = 0.15;
constexpr int kFramesOfAnAct = 6;
/// Simulated time.
constexpr double kLongestSession_s = 3600.0;

double thread_cpu_s() {
  timespec used{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

}  // namespace

Person::Person(Parameters parameters) : parameters_(std::move(parameters)) {
  for (const char* view : {"start", "prepare", "session", "apparatus", "sessions", "overview",
                           "record", "results", "study", "device", "data"}) {
    frames_[view] = {};
  }
  for (app::gui::HeadlessUi* ui : {&ui_, &participant_}) {
    ui->frame_s = static_cast<float>(kFrame_s);
  }
  application_ = std::make_unique<app::gui::Application>(
      app::WindowRequest{.device = "lumped",
                         .allow_no_realtime = true,
                         .simulated_clock_s = [this] { return now_s(); }},
      [] {});
  application_->set_monitors(
      {{.name = "Left", .width_px = 1920, .height_px = 1080, .has_window = true},
       {.name = "Middle", .x_px = 1920, .width_px = 1920, .height_px = 1080},
       {.name = "Right", .x_px = 3840, .width_px = 1280, .height_px = 720}});
  frame();
}

void Person::frame() {
  application_->beat(true);
  if (num_frames_ % kFramesBetweenLooksBeside == 0) (void)application_->look_beside();
  double used_s = 0.0;
  std::string view;
  ui_.one_frame([&](Ui& ui) {
    view = application_->view_name();
    ui.set_view(view.c_str());
    const double before_s = thread_cpu_s();
    application_->draw(ui);
    used_s = thread_cpu_s() - before_s;
  });
  frames_[view].add(used_s, now_s() / parameters_.duration_s);
  if (!application_->participant_place().nowhere) {
    participant_.one_frame([&](Ui& ui) { application_->draw_participant(ui); });
  }
  ++num_frames_;
  clock_s_.store(static_cast<double>(num_frames_) * kFrame_s);
}

void Person::draw_frames(int count) {
  for (int i = 0; i < count; ++i) frame();
}

void Person::look() {
  const int count = static_cast<int>(parameters_.look_s / kFrame_s);
  for (int i = 0; i < count; ++i) {
    const auto step = static_cast<float>(i % 90);
    ui_.move(200 + 12 * step, 150 + 8 * step);
    frame();
  }
}

void Person::think() { draw_frames(static_cast<int>(parameters_.look_s / 4.0 / kFrame_s)); }

/// Draws frames until the input is taken and carried out: the window holds input as long as the
/// session has not yet done what was asked of it.
void Person::settle() {
  ui_.move(5, 5);
  if (!until([&] { return ui_.queue().empty(); }, 5.0)) miss("input is held");
  frame();
}

bool Person::until(const std::function<bool()>& it, double patience_s) {
  const auto end = Clock::now() + std::chrono::duration<double>(patience_s);
  while (!it()) {
    if (Clock::now() > end) return false;
    frame();
    std::this_thread::sleep_for(kBetweenLooksAtWork);
  }
  return true;
}

bool Person::offers(const std::string& name) const {
  const Drawn::Widget* widget = ui_.drawn().find(name);
  return widget != nullptr && widget->enabled && !widget->is_covered &&
         widget->place.width * widget->place.height > 0;
}

void Person::miss(const std::string& what) {
  const std::string told = std::string(application_->view_name()) + ": " + what;
  if (std::ranges::find(missed_, told) != missed_.end()) return;
  missed_.push_back(told);
  std::string shown;
  const std::vector<std::string>& texts = ui_.drawn().texts;
  constexpr std::size_t kMostTexts = 30;
  for (std::size_t i = texts.size() - std::min(texts.size(), kMostTexts); i < texts.size();
       ++i) {
    shown += " | " + texts[i];
  }
  std::fprintf(stderr, "jnd_soak: %s, where this stands:%s\n", told.c_str(), shown.c_str());
  if (offers("message_close")) ui_.press(Key::kEnter);
}

/// Clicks the widget once it is offered, and draws the frames in which it opens.
bool Person::use(const std::string& name, double patience_s) {
  if (!until([&] { return offers(name); }, patience_s)) {
    miss(name + " was not offered");
    return false;
  }
  ui_.click(name);
  draw_frames(kFramesOfAnAct);
  settle();
  return true;
}

void Person::press(const Chord& chord) {
  ui_.press(chord);
  draw_frames(kFramesOfAnAct);
  settle();
}

void Person::type(const std::string& text) {
  ui_.type(text);
  draw_frames(static_cast<int>(text.size()) * 2 + 4);
  settle();
}

void Person::come_to(const std::string& view) {
  if (!until([&] { return application_->view_name() == view; }, 10.0)) {
    miss(view + " did not come");
  }
  look();
}

void Person::look_into(const std::string& name) {
  if (!use(name)) return;
  look();
  press({.key = Key::kF2});
}

void Person::look_at_keys() {
  press({.key = Key::kF1});
  if (!offers("keys_close")) miss("no dialog of all keys");
  look();
  press({.key = Key::kF1});
}

/// Shows the participant's screen on another monitor each time and closes it; a session opens
/// it again.
void Person::look_at_participant_screens() {
  press({.key = Key::kF9});
  look();
  use(num_rounds_ % 2 == 0 ? "screen_1" : "screen_2");
  look();
  use("screen_close");
}

void Person::finish_work() {
  if (!until([&] { return !application_->works(); }, 60.0)) miss("work does not end");
  draw_frames(2);
  think();
}

/// Two folders are used by turns, as the window may hold the last one open until it has the
/// next.
void Person::go_round() {
  look_at_start();
  const fs::path folder =
      parameters_.folder / (num_rounds_ % 2 == 0 ? "one.study" : "other.study");
  ++num_rounds_;
  fs::remove_all(folder);
  fs::copy(parameters_.template_study, folder, fs::copy_options::recursive);
  application_->dropped(folder);
  come_to("sessions");
  const std::pair<const char*, void (Person::*)()> parts[] = {
      {"study", &Person::look_at_study},        {"results", &Person::look_at_results},
      {"device", &Person::look_at_device},      {"overview", &Person::look_at_overview},
      {"record", &Person::look_at_record},      {"preparation", &Person::prepare},
      {"session", &Person::run_session},        {"data", &Person::look_at_data},
      {"another", &Person::open_another_window}};
  std::string told;
  for (const auto& [name, part] : parts) {
    const auto begin = Clock::now();
    (this->*part)();
    const std::chrono::duration<double> took = Clock::now() - begin;
    told += std::string(" ") + name + " " + std::to_string(took.count());
  }
  if (parameters_.tells) std::fprintf(stderr, "round, seconds:%s\n", told.c_str());
  for (int times = 0; times < 2; ++times) {
    press({.key = letter('D'), .control = true});
    think();
  }
  press({letter('0'), true});
  come_to("start");
  finish_work();
}

void Person::look_at_start() {
  look_into("new_study");
  look_into("open_study");
  look_at_keys();
  for (const Key key : {Key::kPlus, Key::kMinus}) {
    press({.key = key, .control = true});
    think();
  }
}

void Person::look_at_study() {
  look_into("back_up");
  use("verify");
  finish_work();
  use("tab_study");
  come_to("study");
  use("more_participants");
  use("fewer_participants");
  ui_.move(800, 500);
  ui_.wheel(-3);
  draw_frames(8);
  look();
  look_at_keys();
}

void Person::look_at_results() {
  use("tab_results");
  come_to("results");
  finish_work();
  for (const char* page : {"page_charts", "page_boxes", "page_comparisons", "page_numbers"}) {
    if (offers(page)) use(page);
    look();
  }
  press({.key = Key::kDown});
  look_into("export");
  use("tab_sessions");
  come_to("sessions");
}

void Person::look_at_device() {
  use("tab_device");
  come_to("device");
  finish_work();
  for (const char* page : {"page_daily", "page_force", "page_watch"}) {
    use(page);
    look();
  }
  if (use("watch")) {
    until([] { return false; }, kWatched_s);
    look();
    use("leave_off");
    finish_work();
  }
  use("page_commission");
  use("tab_sessions");
  come_to("sessions");
}

void Person::look_at_overview() {
  use("overview");
  come_to("overview");
  finish_work();
  look_into("plan_number");
  look_into("add_appointment");
  press({letter('1'), true});
  come_to("sessions");
}

void Person::look_at_record() {
  press({.key = Key::kDown});
  use("show_session");
  come_to("record");
  finish_work();
  for (const char* page : {"page_answers", "page_notes", "page_faults", "page_timeline"}) {
    use(page);
    look();
  }
  press({.key = Key::kBackspace});
  come_to("sessions");
}

void Person::prepare() {
  use("new_session");
  come_to("prepare");
  if (use("map_controls")) {
    look();
    use("controls_close");
  }
  if (offers("real_session")) use("real_session");
  use("start_session", 30.0);
  come_to("session");
}

/// Types and stores a percent. Returns false if none is asked for now.
bool Person::answer_percent() {
  if (ui_.drawn().find("answer_percent") == nullptr || offers("present")) return false;
  if (!offers("answer_percent") && !ui_.drawn().shows("type the percent")) return false;
  if (!offers("answer_percent")) type("120");
  return offers("answer_percent") && use("answer_percent");
}

/// Answers in some way whatever is asked. Returns false if nothing is asked now.
bool Person::answer() {
  for (const char* name : {"message_close", "doubt_store", "release_stop", "rearm"}) {
    if (offers(name)) return use(name);
  }
  if (offers("item_text")) {
    type("1.8");
    press({.key = Key::kEnter});
    return true;
  }
  if (answer_percent()) return true;
  // A break is never ended early, as that would have to be explained.
  if (offers("finish_break"))
    return ui_.drawn().shows("The rest is over") && use("finish_break");
  for (const char* name :
       {"begin", "go_on", "item_done", "consent_given", "item_yes", "feel_medium",
        "finish_medium", "finish_stage", "present", "answer_yes", "matches"}) {
    if (!offers(name)) continue;
    if (std::string_view(name) == "matches") use("raise_coarse");
    return !offers(name) || use(name);
  }
  return false;
}

/// Opens a note that is not written, the list of keys, the apparatus and the emergency stop.
void Person::interrupt_session() {
  press({letter('N'), true});
  press({.key = Key::kF2});
  look_at_keys();
  look_at_participant_screens();
  if (use("apparatus")) {
    look();
    use("apparatus");
  }
  application_->escape();
  use("release_stop");
  use("rearm");
}

void Person::run_session() {
  const double begin_s = now_s();
  int num_acts = 0;
  bool is_interrupted = false;
  while (!ui_.drawn().shows("Session finished")) {
    if (now_s() > begin_s + kLongestSession_s) {
      miss("the session does not come to its end");
      break;
    }
    if (answer()) {
      ++num_acts;
      think();
    }
    frame();
    constexpr int kActsUntilItIsInterrupted = 8;
    if (!is_interrupted && num_acts > kActsUntilItIsInterrupted) {
      is_interrupted = true;
      interrupt_session();
    }
  }
  in_sessions_s_ += now_s() - begin_s;
  ++num_sessions_;
  look();
  use("to_sessions", 30.0);
  come_to("overview");
  finish_work();
  press({letter('1'), true});
  come_to("sessions");
}

void Person::look_at_data() {
  application_->dropped(parameters_.table);
  come_to("data");
  finish_work();
  for (const char* page : {"page_curves", "page_comparison", "page_command", "page_table"}) {
    if (offers(page)) use(page);
    finish_work();
    look();
  }
}

/// Opens and leaves another window as another program would: what one window leaves behind
/// counts as well.
void Person::open_another_window() {
  app::gui::Application other({.study_folder = parameters_.template_study}, [] {});
  for (int i = 0; i < 5; ++i) {
    other.beat(true);
    participant_.one_frame([&](Ui& ui) {
      ui.set_view(other.view_name());
      other.draw(ui);
    });
  }
  other.ask_to_close();
  if (!other.closed()) miss("another window does not close");
}

}  // namespace jnd::soak
