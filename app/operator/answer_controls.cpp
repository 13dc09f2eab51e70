#include "app/operator/answer_controls.h"

#include <algorithm>
#include <utility>

#include "app/language/words.h"
#include "app/operator/kept_controls.h"

namespace jnd::app {
namespace {

using core::ControlReader;

constexpr char kStopAction[] = "stop", kHoldAction[] = "hold";
/// On a keyboard that only we listen to, Escape remains the emergency stop.
constexpr char kEscapeKey[] = "KEY_ESC";
/// Presses that nobody has looked at; nobody who maps controls makes more.
constexpr std::size_t kMostWaitingEvents = 256;

bool is_stop(std::string_view action) { return action == kStopAction || action == kHoldAction; }

}  // namespace

AnswerControls::AnswerControls(Parameters parameters)
    : parameters_(std::move(parameters)),
      map_(kept_controls(parameters_.file)),
      shared_map_(map_),
      reader_([this] {
        ControlReader::Parameters reader = parameters_.reader;
        reader.on_event = [this](const core::ControlEvent& event) { take(event); };
        reader.on_change = parameters_.wake;
        reader.on_lost = [this](const std::string& device) { lost(device); };
        return reader;
      }()) {
  has_hold_ = map_.control_of(kHoldAction) != nullptr;
}

void AnswerControls::set(const std::string& action, const core::Control& control) {
  map_.set(action, control);
  keep();
}

void AnswerControls::forget(const std::string& action) {
  map_.forget(action);
  keep();
}

void AnswerControls::keep() {
  {
    const std::lock_guard guard(mutex_);
    shared_map_ = map_;
  }
  has_hold_ = map_.control_of(kHoldAction) != nullptr;
  is_held_ = false;
  listen();
  keep_controls(parameters_.file, map_);
}

void AnswerControls::begin_session(std::function<void(const operate::UseControl&)> use) {
  {
    const std::lock_guard guard(mutex_);
    use_ = std::move(use);
  }
  has_session_ = true;
  listen();
}

void AnswerControls::end_session() {
  has_session_ = false;
  {
    const std::lock_guard guard(mutex_);
    use_ = nullptr;
  }
  listen();
}

void AnswerControls::prepare(bool wanted) {
  if (std::exchange(is_preparing_, wanted) == wanted) return;
  listen();
}

void AnswerControls::listen_to_all(bool wanted) {
  if (std::exchange(is_mapping_, wanted) == wanted) return;
  listen();
}

void AnswerControls::listen() {
  using Listens = ControlReader::Listens;
  reader_.listen(is_mapping_                     ? Listens::kToAll
                 : has_session_ || is_preparing_ ? Listens::kToMapped
                                                 : Listens::kToNobody,
                 map_);
}

std::vector<core::ControlEvent> AnswerControls::take_events() {
  const std::lock_guard guard(mutex_);
  return std::exchange(events_, {});
}

std::map<std::string, std::string> AnswerControls::words() const {
  std::map<std::string, std::string> all;
  for (const core::ControlMap::Row& row : map_.rows()) {
    all[row.action] = core::words_of(row.control);
  }
  return all;
}

void AnswerControls::stop() noexcept {
  if (has_session_) {
    if (parameters_.press_stop) parameters_.press_stop();
  } else {
    stop_is_asked_ = true;
  }
}

/// Called by the reader's thread. It treats the stop before anything else.
void AnswerControls::take(const core::ControlEvent& event) {
  {
    const std::lock_guard guard(mutex_);
    const std::string action = shared_map_.action_of(event.control);
    const bool is_escape = action.empty() && event.control.name == kEscapeKey &&
                           shared_map_.names(event.control.device);
    if (action == kHoldAction) {
      is_held_ = event.is_down;
      if (!event.is_down && has_session_) stop();
    } else if ((action == kStopAction || is_escape) && event.is_down) {
      stop();
    } else if (event.is_down && use_ && !action.empty()) {
      use_({.action = action,
            .control = core::stored_words(event.control),
            .pressed_ns = event.monotonic_ns});
    }
    if (events_.size() < kMostWaitingEvents) events_.push_back(event);
  }
  if (parameters_.wake) parameters_.wake();
}

void AnswerControls::lost(const std::string& device) {
  {
    const std::lock_guard guard(mutex_);
    const bool had_stop =
        std::ranges::any_of(shared_map_.rows(), [&](const core::ControlMap::Row& row) {
          return is_stop(row.action) && row.control.device == device;
        });
    if (had_stop) {
      is_held_ = false;
      if (has_session_) stop();
    }
  }
  if (parameters_.wake) parameters_.wake();
}

std::optional<PreflightLine> controls_line(
    const core::ControlMap& map, const std::vector<ControlReader::DeviceState>& devices,
    bool participant_answers) {
  using Status = PreflightLine::Status;
  if (map.rows().empty() && !participant_answers) return std::nullopt;
  PreflightLine line{.name = tr("Pedals and buttons")};
  std::string missing, problem;
  bool lacks_stop = false;
  for (const core::ControlMap::Row& row : map.rows()) {
    const auto device =
        std::ranges::find(devices, row.control.device, &ControlReader::DeviceState::device);
    if (device != devices.end() && device->problem.empty()) continue;
    missing = core::words_of(row.control);
    problem = device != devices.end() ? device->problem : "";
    lacks_stop |= is_stop(row.action);
  }
  const bool has_answers =
      std::ranges::any_of(map.rows(), [](const core::ControlMap::Row& row) {
        return !is_stop(row.action) && row.action != "present";
      });
  if (lacks_stop) {
    line.status = Status::kFailed;
    line.found = tr("the participant's stop is not there");
    line.remedy =
        !problem.empty()
            ? problem
            : tr("plug it in ({}), or forget it in the list of pedals and buttons", missing);
  } else if (participant_answers && !has_answers) {
    line.status = Status::kWarning;
    line.found = tr("none has an answer");
    line.remedy =
        tr("this study is answered by the participant: map a pedal or a button to each answer");
  } else if (!missing.empty()) {
    line.status = Status::kWarning;
    line.found = tr("not all are there");
    line.remedy = !problem.empty() ? problem : tr("plug it in: {}", missing);
  } else {
    line.status = Status::kOk;
    line.found = trn("{} is mapped", "{} are mapped", std::ssize(map.rows()));
  }
  return line;
}

std::string action_words(std::string_view action) {
  if (action == "first") return tr("The first interval");
  if (action == "second") return tr("The second interval");
  if (action == "third") return tr("The third interval");
  if (action == "yes") return tr("Yes, or different");
  if (action == "no") return tr("No, or the same");
  if (action == "cannot_tell") return tr("Cannot tell");
  if (action == "present") return tr("Present what comes next");
  if (action == "lower") return tr("Lower");
  if (action == "raise") return tr("Raise");
  if (action == "lower_fine") return tr("A bit lower");
  if (action == "raise_fine") return tr("A bit higher");
  if (action == "matches") return tr("It matches");
  if (action == kStopAction) return tr("Participant's stop: press");
  if (action == kHoldAction) return tr("Participant's stop: let go");
  if (action.starts_with("step_"))
    return tr("Step {} of a scale", std::string(action.substr(5)));
  return std::string(action);
}

}  // namespace jnd::app
