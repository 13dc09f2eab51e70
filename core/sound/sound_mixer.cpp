#include "core/sound/sound_mixer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/clock.h"
#include "core/require.h"
#include "core/sound/sound_level.h"

namespace jnd::core {

SoundMixer::Voice::Voice(const LevelledNoise& levelled, double rate_hz, std::uint64_t seed)
    : noise(levelled.shape, rate_hz, seed), rms(rms_of_level(levelled.level_dbfs)) {
  require(levelled.level_dbfs <= kLoudestNoise_dbfs, "level_dbfs",
          "a level of at most -15 dBFS", levelled.level_dbfs);
}

double SoundMixer::Voice::next() noexcept {
  const double x = noise.next();
  if (step != 0.0) {
    place += step;
    if (place >= 1.0 || place <= 0.0) {
      place = std::clamp(place, 0.0, 1.0);
      step = 0.0;
    }
  }
  if (place >= 1.0) return rms * x;
  return rms * std::sin(0.5 * std::numbers::pi * place) * x;
}

SoundMixer::SoundMixer(const Parameters& parameters)
    : rate_hz_(parameters.rate_hz),
      cue_delay_ns_(std::llround(1e9 * parameters.cue_delay_s)),
      limiter_(parameters.rate_hz) {
  require_positive(parameters.rate_hz, "rate_hz");
  require(parameters.cue_delay_s >= 0.0 && parameters.cue_delay_s < 10.0, "cue_delay_s",
          "a time in [0, 10) s", parameters.cue_delay_s);
  require(parameters.noises.size() <= kMostNoises, "noises", "at most 64 noises",
          static_cast<double>(parameters.noises.size()));
  for (const LevelledNoise& noise : parameters.noises) {
    voices_.emplace_back(
        noise, rate_hz_,
        derived_seed(parameters.seed, "noise", {static_cast<std::int64_t>(voices_.size())}));
  }
  for (const Tone& cue : parameters.cues) cues_.push_back(samples_of(cue, rate_hz_));
}

bool SoundMixer::play_noise(int noise, double ramp_s) noexcept {
  return requests_.try_push({.kind = Request::Kind::kNoise, .noise = noise, .ramp_s = ramp_s});
}

bool SoundMixer::play_cue(std::size_t cue, std::uint64_t id, std::int64_t asked_ns) noexcept {
  return requests_.try_push(
      {.kind = Request::Kind::kCue, .cue = cue, .id = id, .asked_ns = asked_ns});
}

void SoundMixer::turn_to(int noise, double ramp_s) noexcept {
  const double step = ramp_s > 0.0 ? 1.0 / (ramp_s * rate_hz_) : 1.0;
  for (std::size_t i = 0; i < voices_.size(); ++i) {
    Voice& voice = voices_[i];
    const bool is_wanted = noise >= 0 && i == static_cast<std::size_t>(noise);
    if (is_wanted && voice.place < 1.0) voice.step = step;
    if (!is_wanted) voice.step = voice.place > 0.0 ? -step : 0.0;
  }
}

/// Returns false if the largest number of cues is sounding. The cue then has to wait.
bool SoundMixer::begin_cue(const Request& request, std::int64_t heard_ns) noexcept {
  if (request.cue >= cues_.size()) return true;
  auto* const free = std::find_if(sounding_.begin(), sounding_.end(),
                                  [](const Sounding& one) { return one.samples == nullptr; });
  if (free == sounding_.end()) return false;
  const std::int64_t until_ns =
      std::max<std::int64_t>(0, request.asked_ns + cue_delay_ns_ - heard_ns);
  // If the output's clock is wrong, a cue still waits no longer than twice the delay.
  const auto wait = static_cast<std::size_t>(
      std::min(static_cast<double>(until_ns), 2.0 * static_cast<double>(cue_delay_ns_)) *
      rate_hz_ / static_cast<double>(kNsPerS));
  *free = {.samples = &cues_[request.cue], .next = 0, .wait = wait};
  const auto begins_ns = heard_ns + std::llround(static_cast<double>(wait) / rate_hz_ * 1e9);
  (void)heard_.try_push(
      {.id = request.id, .asked_ns = request.asked_ns, .heard_ns = begins_ns});
  return true;
}

void SoundMixer::take_requests(std::int64_t heard_ns) noexcept {
  Request request;
  // A place becomes free within the duration of the longest cue. Later requests wait until
  // then.
  while (std::any_of(sounding_.begin(), sounding_.end(),
                     [](const Sounding& one) { return one.samples == nullptr; }) &&
         requests_.try_pop(request)) {
    if (request.kind == Request::Kind::kNoise) {
      turn_to(request.noise, request.ramp_s);
    } else {
      (void)begin_cue(request, heard_ns);
    }
  }
}

double SoundMixer::cues_now() noexcept {
  double sum = 0.0;
  for (Sounding& one : sounding_) {
    if (one.samples == nullptr) continue;
    if (one.wait > 0) {
      --one.wait;
      continue;
    }
    sum += static_cast<double>((*one.samples)[one.next]);
    if (++one.next == one.samples->size()) one.samples = nullptr;
  }
  return sum;
}

void SoundMixer::render(std::span<float> samples, std::int64_t heard_ns) noexcept {
  take_requests(heard_ns);
  for (float& sample : samples) {
    double sum = cues_now();
    for (Voice& voice : voices_) {
      if (voice.is_heard()) sum += voice.next();
    }
    sample = static_cast<float>(limiter_.next(sum));
  }
  num_frames_.store(
      num_frames_.load(std::memory_order_relaxed) + static_cast<std::int64_t>(samples.size()),
      std::memory_order_relaxed);
  num_limited_.store(limiter_.num_limited(), std::memory_order_relaxed);
}

}  // namespace jnd::core
