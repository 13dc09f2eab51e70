#include "app/sound/tried_sound.h"

#include <random>

#include "app/sound/sound_plan.h"
#include "core/sound/sound_level.h"
#include "device/sound/alsa_output.h"

namespace jnd::app {

using experiments::MaskingNoise;

namespace {

std::chrono::steady_clock::duration duration_of(double duration_s) {
  return std::chrono::duration_cast<std::chrono::steady_clock::duration>(
      std::chrono::duration<double>(duration_s));
}

}  // namespace

TriedSound::TriedSound(const Parameters& parameters) {
  const MaskingNoise& noise = parameters.sound.masking_noise;
  core::SoundMixer::Parameters mixed{.seed = std::random_device{}()};
  if (noise.kind != MaskingNoise::Kind::kNone) {
    level_dbfs_ = app::noise_level_dbfs(noise, parameters.calibration);
    mixed.noises.push_back({.shape = shape_of(noise), .level_dbfs = *level_dbfs_});
  }
  for (const experiments::Cue& cue : parameters.sound.cues) {
    mixed.cues.push_back({.frequency_hz = cue.frequency_hz,
                          .duration_s = cue.duration_s,
                          .level_dbfs = level_dbfs_of(cue.level, parameters.calibration,
                                                      core::kLoudestCue_dbfs)});
  }
  num_cues_ = mixed.cues.size();
  output_ = parameters.open ? parameters.open(parameters.output)
                            : device::open_alsa_output(parameters.output);
  mixed.rate_hz = output_->rate_hz();
  mixed.cue_delay_s = output_->longest_latency_s();
  mixer_ = std::make_unique<core::SoundMixer>(mixed);
  if (level_dbfs_) (void)mixer_->play_noise(0, kRise_s);
  output_->start(*mixer_);
}

void TriedSound::give_next_cue() {
  if (num_cues_ == 0 || over_at_) return;
  for (core::HeardCue heard; mixer_->next_heard(heard);) {
  }
  const auto now_ns = std::chrono::duration_cast<std::chrono::nanoseconds>(
                          std::chrono::steady_clock::now().time_since_epoch())
                          .count();
  (void)mixer_->play_cue(num_given_ % num_cues_, num_given_ + 1, now_ns);
  ++num_given_;
}

void TriedSound::end() {
  if (over_at_) return;
  (void)mixer_->play_noise(core::SoundMixer::kNoNoise, kFall_s);
  over_at_ =
      std::chrono::steady_clock::now() + duration_of(kFall_s + output_->longest_latency_s());
}

bool TriedSound::is_over() const {
  return over_at_ && std::chrono::steady_clock::now() >= *over_at_;
}

}  // namespace jnd::app
