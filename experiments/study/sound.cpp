#include "experiments/study/sound.h"

#include <algorithm>
#include <variant>

#include "experiments/study/study.h"

namespace jnd::experiments {
namespace {

void collect_sounds(const Study& study, const std::vector<Stage>& stages,
                    std::vector<Sound>& found) {
  for (const Stage& stage : stages) {
    if (const auto* block = std::get_if<Block>(&stage.content)) {
      Sound sound = sound_of(study, block);
      if (std::ranges::find(found, sound) == found.end()) found.push_back(std::move(sound));
    } else if (const auto* both = std::get_if<Counterbalance>(&stage.content)) {
      for (const Counterbalance::Arm& arm : both->arms)
        collect_sounds(study, arm.stages, found);
      collect_sounds(study, both->between, found);
    }
  }
}

}  // namespace

std::string_view name(CueMoment moment) noexcept {
  switch (moment) {
    case CueMoment::kReady:
      return "ready";
    case CueMoment::kBegin:
      return "begin";
    case CueMoment::kEnd:
      return "end";
  }
  return "";
}

bool Sound::is_required() const noexcept {
  return masking_noise.required || std::ranges::any_of(cues, &Cue::required);
}

const Cue* Sound::cue_of(CueMoment moment) const noexcept {
  const auto found = std::ranges::find(cues, moment, &Cue::moment);
  return found == cues.end() ? nullptr : &*found;
}

Sound sound_of(const Study& study, const Block* block) {
  Sound sound = study.sound;
  if (block == nullptr) return sound;
  if (block->masking_noise) sound.masking_noise = *block->masking_noise;
  if (block->cues) sound.cues = *block->cues;
  return sound;
}

std::vector<Sound> sounds_of(const Study& study) {
  std::vector<Sound> found = {study.sound};
  collect_sounds(study, study.stages, found);
  return found;
}

bool has_sound(const Study& study) {
  return !std::ranges::all_of(sounds_of(study), &Sound::is_silent);
}

bool requires_sound(const Study& study) {
  return std::ranges::any_of(sounds_of(study), &Sound::is_required);
}

}  // namespace jnd::experiments
