#include "analysis/report/report_sound.h"

#include <set>

#include "analysis/results/number_words.h"
#include "analysis/words/said.h"
#include "core/storage/study_store.h"
#include "experiments/study/sound.h"

namespace jnd::analysis {
namespace {

using experiments::Cue;
using experiments::MaskingNoise;
using experiments::Sound;
using experiments::SoundLevel;

std::string level_in_report(const SoundLevel& level) {
  return level.level_db_spl ? said("{} dB SPL", shortest_words(*level.level_db_spl))
                            : said("{} dB re a sine of full scale",
                                   shortest_words(level.level_dbfs.value_or(0.0)));
}

std::string noise_in_report(const MaskingNoise& noise) {
  using Kind = MaskingNoise::Kind;
  const std::string colour = noise.kind == Kind::kWhite ? said("white noise")
                             : noise.kind == Kind::kPink
                                 ? said("pink noise")
                                 : said("noise from {} to {} Hz", shortest_words(noise.low_hz),
                                        shortest_words(noise.high_hz));
  return said("{} at {}", colour, level_in_report(noise.level));
}

std::string cue_in_report(const Cue& cue) {
  const std::string moment =
      cue.moment == experiments::CueMoment::kReady   ? said("when a trial could begin")
      : cue.moment == experiments::CueMoment::kBegin ? said("when a stimulus began")
                                                     : said("when a stimulus was over");
  return said("a tone of {} Hz and {} s at {} {}", shortest_words(cue.frequency_hz),
              shortest_words(cue.duration_s), level_in_report(cue.level), moment);
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
  return said("The study asks for {}; it was played in {} of {}.", heard,
              std::to_string(num_played),
              counted_words(std::ssize(source.sessions), "session"));
}

}  // namespace jnd::analysis
