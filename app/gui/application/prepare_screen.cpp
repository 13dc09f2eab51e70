#include "app/gui/application/prepare_screen.h"

#include <utility>

#include "app/language/words.h"
#include "app/operator/appointments.h"
#include "app/operator/study_words.h"
#include "app/session/fitting.h"
#include "app/session/pseudonym.h"
#include "app/sound/sound_outputs.h"
#include "app/sound/sound_plan.h"
#include "app/sound/sound_settings.h"
#include "core/clock.h"
#include "core/error.h"
#include "device/haptic_device.h"
#include "device/registry/device_registry.h"
#include "experiments/order/counterbalance.h"
#include "experiments/session/plan.h"
#include "experiments/study/stage_walk.h"

namespace jnd::app::gui {
namespace {

/// The devices that need no address, and the one that was asked for. It is too slow for every
/// frame, because it makes each device, and a simulated one is a whole world.
std::vector<PrepareModel::Device> devices_to_choose(const std::string& asked, double rate_hz) {
  std::vector<PrepareModel::Device> all;
  const auto add = [&](const std::string& name, std::string_view description) {
    all.push_back({name, tr(description.data()),
                   device::make_device(name, rate_hz)->capabilities().simulated});
  };
  for (const device::DeviceEntry& entry : device::devices()) {
    if (entry.argument.empty()) add(std::string(entry.name), entry.description);
  }
  const device::DeviceEntry& entry = device::device_named(asked);
  if (!entry.argument.empty()) add(asked, entry.description);
  return all;
}

bool has_participant_answers(const experiments::Study& study) {
  bool any = false;
  experiments::for_each_stage(study.stages, [&](const experiments::Stage& stage) {
    const auto* block = std::get_if<experiments::Block>(&stage.content);
    any |= block != nullptr && block->participant_answers;
  });
  return any;
}

}  // namespace

void PrepareScreen::show() {
  study_.reload();
  mapping_ = {};
  controls_.prepare(true);
  const core::StudyStore store(study_.folder().folder, core::StudyStore::Mode::kReadOnly);
  taken_.clear();
  for (const core::SessionRow& row : store.sessions()) taken_.push_back(row.participant);
  for (const core::WithdrawalRow& gone : store.withdrawals()) {
    taken_.push_back(gone.participant);
  }
  seed_ = request_.seed ? *request_.seed : seed_of(store);
  state_.fields = std::exchange(request_.fields, {});
  state_.fitting = fitting_line(std::exchange(request_.fitting, {}));
  assign(store);
  state_.participant = std::exchange(request_.participant, "");
  if (state_.participant.empty()) state_.participant = std::exchange(proposed_, "");
  if (state_.participant.empty()) {
    state_.participant = next_participant(store, core::appointments(study_.folder().folder),
                                          core::SystemClock().now_ns());
  }
  state_.pilot = state_.kind_is_chosen = request_.pilot;
  if (state_.device.empty()) {
    state_.device =
        request_.device.empty() ? std::string(device::devices().front().name) : request_.device;
  }
  devices_ = devices_to_choose(state_.device, study_.study().device.rate_hz);
  choose_kind(model(), state_);
  state_.language = request_.language.empty() ? shown_language(study_.study().languages)
                                              : std::exchange(request_.language, "");
  look_at_sound();
  look_before();
}

/// Lists the sound outputs, and judges how loud the study will be from the chosen one.
void PrepareScreen::look_at_sound() {
  constexpr std::size_t kMostLetters = 44;
  sound_ = {.is_wanted = experiments::has_sound(study_.study()),
            .is_required = experiments::requires_sound(study_.study())};
  if (!sound_.is_wanted) return;
  const SoundSettings settings;
  try {
    if (state_.sound_output.empty()) state_.sound_output = request_.sound_output;
    if (state_.sound_output.empty()) state_.sound_output = settings.output();
    const std::string asked = state_.sound_output == kSoundOff ? "" : state_.sound_output;
    for (const KnownOutput& one : known_outputs(settings, asked)) {
      sound_.outputs.push_back({.name = one.name,
                                .description = one.description.substr(0, kMostLetters),
                                .is_calibrated = one.calibration.has_value()});
    }
    judge_sound();
  } catch (const core::Error& error) {
    sound_.problem = error.what();
  }
}

void PrepareScreen::judge_sound() {
  sound_.levels.clear();
  sound_.problem.clear();
  if (state_.sound_output == kSoundOff) {
    sound_.problem = tr("Nothing of the study's sound will be heard.");
    return;
  }
  try {
    sound_.levels =
        sound_level_words(study_.study(), SoundSettings().calibration_of(state_.sound_output));
  } catch (const core::Error& error) {
    sound_.problem = error.what();
  }
}

void PrepareScreen::try_sound() {
  if (tried_sound_ != nullptr) return tried_sound_->end();
  static constexpr auto kWhole = std::chrono::seconds(8);
  host_.attempt(tr("The sound cannot be played"), [this] {
    experiments::Sound sound = study_.study().sound;
    if (sound.is_silent()) sound = experiments::sounds_of(study_.study()).back();
    tried_sound_ = std::make_unique<TriedSound>(TriedSound::Parameters{
        .output = state_.sound_output,
        .calibration = SoundSettings().calibration_of(state_.sound_output),
        .sound = sound});
    next_cue_ = std::chrono::steady_clock::now() + std::chrono::seconds(1);
    sound_ends_ = std::chrono::steady_clock::now() + kWhole;
  });
}

void PrepareScreen::go_on_with_tried_sound() {
  if (tried_sound_ == nullptr) return;
  const auto now = std::chrono::steady_clock::now();
  if (const std::string problem = tried_sound_->state().problem; !problem.empty()) {
    sound_.problem = problem;
    tried_sound_.reset();
    return;
  }
  if (now >= sound_ends_) tried_sound_->end();
  if (tried_sound_->is_over()) return tried_sound_.reset();
  if (now < next_cue_) return;
  tried_sound_->give_next_cue();
  next_cue_ += std::chrono::seconds(1);
}

/// Says in words which cell comes next, as soon as the fields that the order depends on are
/// filled in.
void PrepareScreen::assign(const core::StudyStore& store) {
  assigned_.clear();
  const experiments::Study& study = study_.study();
  const bool knows_fields = field_problem(study, state_.fields).empty();
  if (study_.folder().hides_levels || !knows_fields) return;
  assigned_ = cell_words(
      study, experiments::planned_cells(study, experiments::completed_cells(store), seed_,
                                        static_cast<std::int64_t>(store.sessions().size()), 1,
                                        state_.fields)
                 .front());
}

void PrepareScreen::look_before() {
  preflight_ = std::make_unique<Preflight>(
      PreflightRequest{
          .folder = study_.folder().folder,
          .device = state_.device,
          .profile = state_.device == request_.device ? request_.device_profile.string() : "",
          .allow_no_realtime = request_.allow_no_realtime},
      host_.wake());
}

/// Remembers the sound output, so that the next session proposes it.
void PrepareScreen::keep_output() const {
  if (!sound_.is_wanted || state_.sound_output == kSoundOff) return;
  try {
    const SoundSettings settings;
    if (settings.output() != state_.sound_output) settings.choose(state_.sound_output);
  } catch (const core::Error&) {
    // The session begins even if the choice cannot be kept.
  }
}

void PrepareScreen::press_stop() noexcept {
  if (preflight_ != nullptr) preflight_->press_emergency_stop();
}

PrepareModel PrepareScreen::model() const {
  PrepareModel model{.study = study_.folder(),
                     .devices = devices_,
                     .languages = study_.study().languages,
                     .fields = study_.study().participant_fields,
                     .taken = taken_,
                     .assigned = assigned_,
                     .seed = seed_,
                     .sound = sound_};
  model.sound.is_tested = tried_sound_ != nullptr;
  if (preflight_ == nullptr) return model;
  model.lines = preflight_->lines();
  if (auto line = controls_line(controls_.map(), controls_.devices(),
                                has_participant_answers(study_.study()))) {
    model.lines.push_back(std::move(*line));
  }
  if (sound_.is_wanted) model.lines.push_back(sound_line(sound_, state_.sound_output));
  model.looking = preflight_->running();
  model.progress = preflight_->progress();
  return model;
}

void PrepareScreen::forget_study() {
  state_ = {};
  mapping_ = {};
  controls_.listen_to_all(false);
  controls_.prepare(false);
}

void PrepareScreen::draw_controls(Ui& ui) {
  const std::vector<core::ControlReader::DeviceState> devices = controls_.devices();
  const std::optional<core::Control> pressed =
      take_presses(mapping_, controls_.take_events(), devices);
  const ControlsResult result =
      draw_controls_dialog(ui, controls_.map(), devices, pressed, mapping_);
  host_.attempt(tr("The pedals and buttons cannot be kept"), [&] {
    if (result.mapped) controls_.set(result.mapped->first, result.mapped->second);
    if (result.forgotten) controls_.forget(*result.forgotten);
  });
  // This frame was drawn before the change.
  if (result.mapped || result.forgotten) host_.wake()();
  if (!result.is_closed) return;
  mapping_ = {};
  controls_.listen_to_all(false);
}

void PrepareScreen::draw(Ui& ui) {
  go_on_with_tried_sound();
  const PrepareViewResult result = draw_prepare_view(ui, model(), state_);
  if (result.sound.output_changed) {
    tried_sound_.reset();
    judge_sound();
  }
  if (result.sound.test) try_sound();
  if (result.map_controls) {
    mapping_ = {.is_open = true};
    (void)controls_.take_events();  // Drops what was pressed before anybody mapped controls.
    controls_.listen_to_all(true);
  } else if (mapping_.is_open) {
    return draw_controls(ui);
  }
  if (result.look_again) {
    look_before();
  } else if (result.fields_changed) {
    host_.attempt(tr("The order cannot be assigned"), [this] {
      assign(core::StudyStore(study_.folder().folder, core::StudyStore::Mode::kReadOnly));
    });
  }
  if (!result.start && result.tab == StudyTab::kNone) return;
  // From here on the session has the device, or nobody has it.
  preflight_.reset();
  tried_sound_.reset();
  controls_.prepare(false);
  if (result.start) {
    keep_output();
    host_.attempt(tr("The session cannot be started"), [this] {
      host_.start_session({.participant = state_.participant,
                           .device = state_.device,
                           .device_profile = state_.device == request_.device
                                                 ? request_.device_profile.string()
                                                 : "",
                           .seed = seed_,
                           .pilot = state_.pilot,
                           .language = state_.language,
                           .fields = state_.fields,
                           .fitting = fitting_in(state_.fitting, tr("Fitting")),
                           .sound_output = state_.sound_output});
    });
  } else {
    host_.go_to(result.tab);
  }
  if (!host_.shows(*this)) return;
  controls_.prepare(true);
  look_before();
}

}  // namespace jnd::app::gui
