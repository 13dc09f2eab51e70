#include "app/sound/session_sound.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <thread>
#include <utility>

#include "core/error.h"
#include "device/sound/alsa_output.h"

namespace jnd::app {

using namespace experiments;

namespace {

/// The fade at the end of a session, so that nothing clicks, and the most that the output may
/// still have to play.
constexpr double kFade_s = 0.1;
constexpr double kMostToPlay_s = 0.5;

std::int64_t steady_now_ns() noexcept {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

double to_s(std::int64_t time_ns) noexcept { return 1e-9 * static_cast<double>(time_ns); }

}  // namespace

SessionSound::SessionSound(const Parameters& parameters)
    : parameters_(parameters), has_sound_(experiments::has_sound(parameters.study)) {
  if (has_sound_) open();
}

SessionSound::~SessionSound() { fade_out(); }

void SessionSound::open() noexcept {
  output_.reset();
  mixer_.reset();
  part_ = nullptr;
  started_is_told_ = false;
  open_problem_.clear();
  try {
    output_name_ = parameters_.choice.output;
    if (output_name_ == kSoundOff) {
      open_problem_ =
          "sound: expected the study's masking noise or cues, found that sound is "
          "off, as `--sound off` or the window says";
      return;
    }
    if (output_name_.empty()) output_name_ = parameters_.choice.settings.output();
    calibration_ = parameters_.choice.settings.calibration_of(output_name_);
    plan_ = sound_plan(parameters_.study, calibration_);
    output_ = parameters_.choice.open ? parameters_.choice.open(output_name_)
                                      : device::open_alsa_output(output_name_);
    mixer_ = std::make_unique<core::SoundMixer>(
        core::SoundMixer::Parameters{.rate_hz = output_->rate_hz(),
                                     .seed = parameters_.seed,
                                     .noises = plan_.noises,
                                     .cues = plan_.cues,
                                     .cue_delay_s = output_->longest_latency_s()});
    output_->start(*mixer_);
  } catch (const std::exception& error) {
    open_problem_ = error.what();
    output_.reset();
    mixer_.reset();
  }
}

device::SoundOutputState SessionSound::state() const {
  return output_ ? output_->state() : device::SoundOutputState{};
}

std::string SessionSound::problem() const {
  if (!has_sound_) return "";
  return output_ ? state().problem : open_problem_;
}

std::string SessionSound::warning() const {
  std::string wrong = problem();
  const std::int64_t num_gaps = state().num_underruns;
  if (!wrong.empty() || num_gaps == 0) return wrong;
  return fmt::format("{} of {} so far",
                     num_gaps == 1 ? "1 gap" : fmt::format("{} gaps", num_gaps), output_name_);
}

void SessionSound::try_again() {
  if (!has_sound_ || is_closed_ || problem().empty() ||
      parameters_.choice.output == kSoundOff) {
    return;
  }
  open();
}

void SessionSound::require_heard() const {
  const std::string wrong = problem();
  if (wrong.empty() || !requires_sound(parameters_.study)) return;
  throw core::Error("the study requires its sound: " + wrong);
}

void SessionSound::play(const Block* block) {
  if (!mixer_ || is_closed_) return;
  const SoundPlan::Part& wanted = plan_.part_of(sound_of(parameters_.study, block));
  if (part_ == &wanted) return;
  const bool same_noise = part_ != nullptr && part_->noise == wanted.noise;
  const SoundPlan::Part* before = std::exchange(part_, &wanted);
  // A noise ends with its own ramp, and begins with its own ramp.
  const double ramp_s = wanted.noise == core::SoundMixer::kNoNoise && before != nullptr
                            ? before->sound.masking_noise.ramp_s
                            : wanted.sound.masking_noise.ramp_s;
  if (!same_noise) (void)mixer_->play_noise(wanted.noise, ramp_s);
}

void SessionSound::cue(CueMoment moment, std::int64_t trial, std::int64_t attempt,
                       std::int64_t presentation) {
  if (!mixer_ || part_ == nullptr || is_closed_) return;
  const std::optional<std::size_t> tone = part_->cues[static_cast<std::size_t>(moment)];
  if (!tone) return;
  const std::int64_t now_ns = steady_now_ns();
  if (!mixer_->play_cue(*tone, ++num_asked_, now_ns)) {
    ++num_lost_;
    return;
  }
  asked_.push_back({.id = num_asked_,
                    .cue = {.moment = std::string(name(moment)),
                            .trial = trial,
                            .attempt = attempt,
                            .presentation = presentation,
                            .asked_monotonic_s = to_s(now_ns)}});
}

void SessionSound::collect_cues() {
  if (!mixer_) return;
  for (core::HeardCue heard; mixer_->next_heard(heard);) {
    while (!asked_.empty() && asked_.front().id <= heard.id) {
      AskedCue asked = std::move(asked_.front());
      asked_.pop_front();
      if (asked.id != heard.id) {
        ++num_lost_;
        continue;
      }
      asked.cue.heard_monotonic_s = to_s(heard.heard_ns);
      heard_.push_back(std::move(asked.cue));
    }
  }
}

void SessionSound::follow(Session& session) {
  if (!has_sound_) return;
  const std::string wrong = problem();
  if (wrong.empty() && !started_is_told_ && output_ && !state().scheduler.empty()) {
    started_is_told_ = true;
    told_problem_.clear();
    SoundStarted started{.output = output_->words(),
                         .scheduler = state().scheduler,
                         .rate_hz = output_->rate_hz(),
                         .cue_delay_s = output_->longest_latency_s()};
    if (calibration_) {
      started.full_scale_db_spl = calibration_->full_scale_db_spl;
      started.calibrated_on = calibration_->measured_on;
    }
    const SoundPlan::Part& all = plan_.part_of(parameters_.study.sound);
    if (all.noise != core::SoundMixer::kNoNoise) {
      started.noise_level_dbfs = plan_.noises[static_cast<std::size_t>(all.noise)].level_dbfs;
    }
    session.sound_started(started);
  }
  if (!wrong.empty() && wrong != told_problem_) {
    told_problem_ = wrong;
    session.sound_missing({wrong});
  }
  collect_cues();
  if (!heard_.empty()) session.cues_played({std::exchange(heard_, {})});
}

void SessionSound::measure(Session& session) {
  if (!output_) return;
  const device::SoundOutputState now = state();
  session.sound_measured({.num_frames = mixer_->num_frames(),
                          .num_underruns = now.num_underruns,
                          .num_limited = mixer_->num_limited(),
                          .num_lost_cues = num_lost_,
                          .max_latency_s = now.max_latency_s});
}

void SessionSound::fade_out() noexcept {
  if (!output_ || !mixer_ || part_ == nullptr || is_closed_) return;
  is_closed_ = true;
  if (!state().problem.empty()) return;
  (void)mixer_->play_noise(core::SoundMixer::kNoNoise, kFade_s);
  const double wait_s = kFade_s + std::min(kMostToPlay_s, output_->longest_latency_s());
  std::this_thread::sleep_for(std::chrono::duration<double>(wait_s));
}

void SessionSound::close(Session& session) {
  if (!has_sound_ || is_closed_) return;
  fade_out();
  is_closed_ = true;
  follow(session);
  num_lost_ += static_cast<std::int64_t>(asked_.size());
  asked_.clear();
  measure(session);
  output_.reset();
  mixer_.reset();
}

}  // namespace jnd::app
