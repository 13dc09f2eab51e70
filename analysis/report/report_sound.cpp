#include "analysis/report/report_sound.h"

#include <set>

#include "analysis/results/number_words.h"
#include "core/storage/study_store.h"
#include "experiments/study/sound.h"

namespace jnd::analysis {
namespace {

using experiments::Cue;
using experiments::MaskingNoise;
using experiments::Sound;
using experiments::SoundLevel;

std::string level_in_report(const SoundLevel& level) {
  return level.level_db_spl
             ? shortest_words(*level.level_db_spl) + " dB SPL"
             : shortest_words(level.level_dbfs.value_or(0.0)) + " dB re a sine of full scale";
}

std::string noise_in_report(const MaskingNoise& noise) {
  using Kind = MaskingNoise::Kind;
  const std::string colour = noise.kind == Kind::kWhite ? "white noise"
                             : noise.kind == Kind::kPink
                                 ? "pink noise"
                                 : "noise from " + shortest_words(noise.low_hz) + " to " +
                                       shortest_words(noise.high_hz) + " Hz";
  return colour + " at " + level_in_report(noise.level);
}

std::string cue_in_report(const Cue& cue) {
  const std::string moment =
      cue.moment == experiments::CueMoment::kReady   ? "when a trial could begin"
      : cue.moment == experiments::CueMoment::kBegin ? "when a stimulus began"
                                                     : "when a stimulus was over";
  return "a tone of " + shortest_words(cue.frequency_hz) + " Hz and " +
         shortest_words(cue.duration_s) + " s at " + level_in_report(cue.level) + " " + moment;
}

}  // namespace

std::string sound_words(const ChapterSource& source) {
  const experiments::Study& study = source.report.data.written;
  if (!experiments::has_sound(study)) return "";
  std::string heard;
  std::set<std::string> told;
  const auto add = [&](const std::string& words) {
    if (told.insert(words).second) heard += (heard.empty() ? "" : "; ") + words;
  };
  for (const Sound& sound : experiments::sounds_of(study)) {
    if (sound.masking_noise.kind != MaskingNoise::Kind::kNone) {
      add(noise_in_report(sound.masking_noise));
    }
    for (const Cue& cue : sound.cues) add(cue_in_report(cue));
  }
  std::size_t num_played = 0;
  for (const core::SessionRow& session : source.sessions) {
    for (const core::EventRow& event : source.report.store.events(session.session)) {
      if (event.kind != "sound_started") continue;
      ++num_played;
      break;
    }
  }
  return "The study asks for " + heard + "; it was played in " + std::to_string(num_played) +
         " of " + counted_words(std::ssize(source.sessions), "session") + ".";
}

}  // namespace jnd::analysis
