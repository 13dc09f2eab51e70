#include "app/gui/application/application.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "app/gui/views/keys_dialog.h"
#include "app/gui/views/layout.h"
#include "app/gui/views/participant_screen_dialog.h"
#include "app/gui/views/participant_view.h"
#include "app/language/words.h"
#include "app/manual/manual_place.h"
#include "app/operator/kept_controls.h"
#include "app/operator/open_outside.h"
#include "app/operator/participant_words.h"
#include "app/operator/remembered_stop.h"
#include "app/session/shipped_files.h"
#include "core/clock.h"
#include "core/error.h"

namespace jnd::app::gui {

namespace fs = std::filesystem;

constexpr float kZoomStep = 1.1f;

/// The serial button box that the command line names; empty if it names none.
static std::vector<core::ControlReader::SerialBoxPort> serial_boxes_of(
    const WindowRequest& request) {
  if (request.answer_port.empty()) return {};
  return {{.path = request.answer_port, .baud = request.answer_baud}};
}

/// The folder where the choice of the participant's monitor is remembered.
static fs::path screen_folder() { return stops_folder(); }

Application::Application(WindowRequest request, std::function<void()> wake)
    : request_(std::move(request)),
      wake_(std::move(wake)),
      controls_({.file = kept_controls_file(),
                 .reader = {.serial_boxes = serial_boxes_of(request_)},
                 .press_stop = [this] { session_.press_stop(); },
                 .wake = wake_}),
      study_(wake_),
      start_(*this, recent_, request_),
      prepare_(*this, study_, request_, controls_),
      session_(*this, study_, request_.allow_no_realtime,
               request_.resume_session ? request_.device_profile.string() : "",
               request_.streams, request_.markers, controls_, request_.sound_output,
               request_.simulated_clock_s),
      record_(*this, study_),
      study_screen_(*this, study_),
      device_(*this, study_, request_),
      data_(*this),
      other_screens_(make_screens({*this, study_, request_})),
      participant_stop_(ParticipantStop::key_named(request_.participant_stop),
                        request_.participant_holds ? ParticipantStop::Way::kHold
                                                   : ParticipantStop::Way::kPress) {
  for (const auto& screen : other_screens_) screens_.push_back(screen.get());
  screen_choice_ = remembered_screen(screen_folder());
  show(start_);
  show_first();
}

/// Shows first what the command line asks for.
void Application::show_first() {
  if (request_.resume_session) {
    attempt(tr("The session cannot be resumed"),
            [this] { resume_session(request_.study_folder, *request_.resume_session); });
  } else if (!request_.study_folder.empty()) {
    attempt(tr("The study cannot be opened"), [this] {
      if (!request_.study_file.empty() && !fs::exists(request_.study_folder / "study.sqlite")) {
        create_study_folder(request_.study_file, request_.study_folder);
      }
      open(request_.study_folder);
      if (!request_.participant.empty()) {
        show(prepare_);
      } else if (request_.shows_results) {
        show(StudyTab::kResults);
      }
    });
  }
}

bool Application::works() const noexcept {
  return study_.works() ||
         std::ranges::any_of(screens_, [](const Screen* screen) { return screen->works(); });
}

void Application::escape() noexcept {
  if (session_.is_live()) {
    session_.press_stop();
  } else if (shows(device_)) {
    device_.press_stop();
  } else {
    prepare_.press_stop();
  }
}

void Application::key_changed(Key key, bool is_down) noexcept {
  if (participant_stop_.key_changed(key, is_down)) escape();
}

/// Presses the stop again if the experimenter released it while nobody holds the participant's
/// switch.
void Application::keep_stopped() noexcept {
  const bool is_let_go = participant_stop_.is_let_go() || controls_.is_let_go();
  if (session_.is_live() && is_let_go && !session_.stop_is_pressed()) escape();
  if (controls_.take_stop()) escape();
}

void Application::mouse_pressed(float x, float y) noexcept {
  if (stop_place_.contains(x, y)) escape();
}

void Application::dropped(const fs::path& path) {
  if (is_live()) return;
  attempt(tr("What was dropped cannot be opened"), [&] {
    const bool is_folder = fs::is_directory(path);
    if (is_folder || !(is_table(path) || shows(data_))) return open(path);
    data_.open(path);
    show(data_);
  });
}

void Application::end_soon() {
  if (session_.is_live()) {
    session_.leave_and_close(as_is("the program was told to end"));
  } else {
    device_.leave_off();
    closed_ = true;
  }
}

void Application::ask_to_close() {
  if (session_.is_live()) {
    session_.ask_to_close();
  } else {
    device_.leave_off();  // What was measured is already on disk.
    closed_ = true;
  }
}

// What screens ask of the window around them.

void Application::show(Screen& screen) {
  screen.show();
  screen_ = &screen;
}

void Application::show(StudyTab tab) {
  const auto found = std::ranges::find(screens_, tab.screen, &Screen::name);
  if (found != screens_.end()) return show(**found);
  if (tab != StudyTab::kNone) {
    throw core::Error(as_is("go_to: expected the name of a screen, found `") +
                      std::string(tab.screen) + as_is("`; see app/gui/application"));
  }
}

void Application::go_to(StudyTab tab) {
  attempt(tr("The view cannot be opened"), [&] { show(tab); });
}

void Application::open(const fs::path& path) {
  if (fs::is_directory(path)) return open_folder(path);
  open_file(path);
}

void Application::open_folder(const fs::path& folder) {
  study_.open(folder);
  forget_study(folder);
  show(StudyTab::kSessions);
}

void Application::open_file(const fs::path& file) {
  study_.close();
  forget_study(file);
  study_screen_.watch(file);
  show(study_screen_);
}

/// Forgets everything about the previous study, and remembers `next` as opened.
void Application::forget_study(const fs::path& next) {
  for (Screen* screen : screens_) screen->forget_study();
  try {
    recent_.add(fs::absolute(next), core::SystemClock().now_ns());
  } catch (const core::Error&) {
    // Work goes on even if the list of recent studies cannot be kept.
  }
}

void Application::start_session(const NewSession& session) {
  session_.start(session);
  session_has_no_screen_ = true;
  show(session_);
}

void Application::resume_session(const fs::path& folder, std::int64_t session) {
  open_folder(folder);
  session_.resume(session);
  session_has_no_screen_ = true;
  show(session_);
}

bool Application::attempt(const char* title, const std::function<void()>& work) {
  try {
    work();
    return true;
  } catch (const std::exception& error) {
    tell(title, error.what());
    return false;
  }
}

void Application::tell(const std::string& title, const std::string& sentence) {
  message_title_ = title;
  message_ = sentence;
}

void Application::draw(Ui& ui) {
  if (study_.collect_work()) {
    attempt(tr("The study cannot be read"), [this] { study_.reload(); });
  }
  keep_stopped();
  session_.set_covered(shows_keys_ || shows_screens_ || !message_.empty());
  screen_->update(ui);
  screen_->draw(ui);
  draw_corner(ui);
  take_global_keys(ui);
  if (!shows_keys_) last_widgets_ = ui.drawn().widgets;
  place_participant();
  if (!message_.empty()) {
    draw_message(ui);
  } else if (shows_screens_) {
    draw_screens(ui);
  } else if (shows_keys_) {
    const KeysResult asked = draw_keys_dialog(ui, last_widgets_);
    shows_keys_ = !asked.closed && !asked.opens_manual;
    if (asked.opens_manual) open_manual();
  }
  if (shows(session_) && session_.view() != nullptr && session_.is_covered() &&
      draw_emergency_stop(ui)) {
    escape();
  }
  const auto& widgets = ui.drawn().widgets;
  const auto stop = std::ranges::find(widgets, "emergency_stop", &Drawn::Widget::name);
  stop_place_ = stop == widgets.end() ? Rect{} : stop->place;
}

/// A new session opens the participant's screen, unless the participant runs it alone and looks
/// at this window.
void Application::place_participant() {
  const SessionView* view = session_.view();
  if (session_has_no_screen_ && session_.is_live() && view != nullptr) {
    session_has_no_screen_ = false;
    shows_participant_ |= !view->is_alone;
  }
  participant_place_ =
      shows_participant_ ? place_of_screen(screen_choice_, monitors_) : ScreenPlace{};
}

void Application::draw_screens(Ui& ui) {
  const ParticipantScreenResult result =
      draw_participant_screen_dialog(ui, shows_participant_ ? screen_choice_ : ScreenChoice{},
                                     monitors_, participant_place_.problem);
  if (result.chosen) {
    screen_choice_ = *result.chosen;
    shows_participant_ = screen_choice_.where != ScreenChoice::Where::kOff;
    remember_screen(screen_folder(), screen_choice_);
    place_participant();
  }
  if (result.is_closed) shows_screens_ = false;
}

void Application::draw_participant(Ui& ui) {
  if (session_.view() != nullptr) {
    return draw_participant_view(
        ui, participant_screen(*session_.view(), session_.typed_answer()), participant_state_);
  }
  ui.text(
      ui.screen().middle(ui.screen().width * 0.8f, 60),
      tr("What the participant is to see comes here with a session."),
      {.font = Font::kLarge, .colour = Colour::kSoft, .align = Align::kCentre, .wrap = true});
}

// What every view shows.

/// The language after the one that is spoken; nullptr if there is no other one.
const Language* Application::next_language() const {
  const auto now = std::ranges::find(languages_, spoken_language(), &Language::code);
  if (languages_.size() < 2) return nullptr;
  const bool is_last = now == languages_.end() || now + 1 == languages_.end();
  return &*(is_last ? languages_.begin() : now + 1);
}

void Application::draw_corner(Ui& ui) {
  // The language changes at the start alone: what was made in one language stays in it, and at
  // the start almost nothing has been made yet.
  const Language* other = shows(start_) ? next_language() : nullptr;
  const CornerLook look = corner_look(ui, other == nullptr ? "" : other->name);
  Rect strip = ui.screen().take_bottom(40);
  strip.take_right(12);
  const auto button = [&](const char* name, const std::string& label, const Chord& key,
                          Tone tone = Tone::kQuiet) {
    const ButtonStyle style{
        .tone = tone, .key = key, .hides_key = !look.has_keys && !shows(session_)};
    const Rect place = strip.take_right(ui.button_width(label, style), 2);
    return ui.button(name, place.middle(place.width, 32), label, style);
  };
  const std::vector<CornerButton> buttons = corner_buttons(ui);
  if (button(buttons[0].name, buttons[0].label, buttons[0].key)) shows_keys_ = true;
  // The session goes on without that screen. The dialog that chooses another monitor has the
  // whole sentence.
  if (!participant_place_.problem.empty() &&
      button("participant_screen", tr("No screen for the participant"), {Key::kF9},
             Tone::kDanger)) {
    shows_screens_ = true;
  }
  if (shows(session_)) return;
  if (button(buttons[1].name, buttons[1].label, buttons[1].key)) make_larger(ui);
  if (button(buttons[2].name, buttons[2].label, buttons[2].key)) {
    ui.theme().set_dark(!ui.theme().dark());
  }
  if (other != nullptr && button("language", other->name, {letter('L'), true})) {
    wanted_language_ = other->code;
    closed_ = true;
  }
}

/// Stops at what the window has room for; otherwise the next few presses of "smaller" would do
/// nothing.
void Application::make_larger(const Ui& ui) {
  const Rect screen = ui.screen();
  constexpr float kRounding = 1.02f;
  const bool has_room =
      screen.width > kRounding * kLeastWidth && screen.height > kRounding * kLeastHeight;
  if (has_room) zoom_ *= kZoomStep;
}

void Application::take_global_keys(Ui& ui) {
  // On other screens, buttons in the corner have these two keys.
  if (shows(session_)) {
    if (ui.pressed({letter('D'), true})) ui.theme().set_dark(!ui.theme().dark());
    if (ui.pressed({Key::kPlus, true})) make_larger(ui);
  }
  if (ui.pressed({Key::kMinus, true})) zoom_ /= kZoomStep;
  zoom_ = std::clamp(zoom_, 0.5f, 2.0f);
  // If something is wrong with the participant's screen, its button has this key.
  const bool has_button = !participant_place_.problem.empty();
  if (!has_button && ui.pressed({Key::kF9})) shows_screens_ = true;
  if (ui.pressed({letter('Q'), true})) ask_to_close();
}

/// Opens the manual's page about this view. It refuses while a hand may feel a force, because
/// another window would take the keyboard, and Escape is the emergency stop in this window
/// alone.
void Application::open_manual() {
  const ManualPlace place = manual_place(shipped_folder(), screen_->manual_page());
  if (place.file.empty()) {
    return tell(tr("The manual cannot be opened"),
                tr("Expected {} beside the program or in the source tree, found it in "
                   "neither. Install the package again, or set JND_SHARE to the source tree.",
                   place.page));
  }
  if (is_live()) {
    return tell(tr("The manual is not opened now"),
                tr("Another window would take the keyboard away, and Escape stops the device "
                   "from this window alone. Look at {} afterwards or on another machine.",
                   place.file.string()));
  }
  const std::string problem = open_outside(place.file);
  if (!problem.empty()) tell(tr("The manual cannot be opened"), problem);
}

void Application::draw_message(Ui& ui) {
  const TextStyle style{.wrap = true};
  const float height = ui.text_height(560, message_, style);
  Rect inside = ui.begin_dialog("message", 620, 150 + std::min(height, 400.0f));
  ui.text(inside.take_top(34, 6), message_title_, {.font = Font::kLarge});
  const ButtonStyle close{.tone = Tone::kPrimary, .key = {Key::kEnter}};
  Rect row = inside.take_bottom(44, 8);
  ui.text(inside, message_, style);
  if (ui.button("message_close", row.take_right(ui.button_width(tr("Close"), close)),
                tr("Close"), close)) {
    message_.clear();
  }
  ui.end_dialog();
}

}  // namespace jnd::app::gui
