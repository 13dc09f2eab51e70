#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/sound/sound_plan.h"
#include "app/sound/sound_settings.h"
#include "core/sound/sound_mixer.h"
#include "device/sound/sound_output.h"
#include "experiments/session/session.h"
#include "experiments/study/study.h"

namespace jnd::app {

/// Where the sound of a session goes to.
struct SoundChoice {
  std::string output{};      ///< "": the machine's own; "off": nowhere; else a name.
  SoundSettings settings{};  ///< Of this machine.
  /// How an output is opened; empty: by ALSA.
  device::OpenSoundOutput open{};
};

/// What a participant hears in a session: noise as the study or the block has it, and cues. It
/// plays on a thread of its output's, and the session's thread asks it and stores what it says.
/// What goes wrong with it never ends a session: it is told, stored and tried again when
/// somebody asks for that. Used by one thread; not real time but for `cue`.
class SessionSound {
 public:
  struct Parameters {
    const experiments::Study& study;
    SoundChoice choice;
    std::uint64_t seed = 0;  ///< Of the session: of the noise, which says nothing of trials.
  };

  /// Opens the output where the study has sound; silent until `play`. The study must outlive
  /// it.
  explicit SessionSound(const Parameters& parameters);
  /// Fades out first where it plays.
  ~SessionSound();
  SessionSound(const SessionSound&) = delete;
  SessionSound& operator=(const SessionSound&) = delete;

  /// Why the study's sound is not heard, a sentence; "" where it is, or the study has none.
  [[nodiscard]] std::string problem() const;
  /// What an experimenter has to know: the problem, or gaps; "" where all is well.
  [[nodiscard]] std::string warning() const;
  /// Opens the output again after a failure. Nothing where it plays, or is off.
  void try_again();
  /// Throws `Error` where the study requires sound and there is none.
  void require_heard() const;

  /// What is heard in this block, or outside of blocks with nullptr: from the next samples on,
  /// over the noise's ramp. Nothing where that is heard already.
  void play(const experiments::Block* block);
  /// Asks for the cue of a moment, where the block has one: `presentation` of the attempt, from
  /// 1, or 0. Real time but for a note to itself.
  void cue(experiments::CueMoment moment, std::int64_t trial, std::int64_t attempt,
           std::int64_t presentation);

  /// Stores what there is to say: that it plays, or why not any more, and cues that were heard.
  /// Waits for the disk.
  void follow(experiments::Session& session);
  /// Stores how it has been.
  void measure(experiments::Session& session);
  /// Fades out, and stores the last of it. Once.
  void close(experiments::Session& session);

 private:
  void open() noexcept;
  void fade_out() noexcept;
  void collect_cues();
  [[nodiscard]] device::SoundOutputState state() const;

  /// A cue that was asked for and that nobody has told to be heard.
  struct AskedCue {
    std::uint64_t id = 0;
    experiments::PlayedCue cue;
  };

  Parameters parameters_;
  bool has_sound_;
  std::string output_name_;
  std::string open_problem_;  ///< Why it could not be opened.
  std::optional<SoundCalibration> calibration_;
  SoundPlan plan_;
  std::unique_ptr<core::SoundMixer> mixer_;
  std::unique_ptr<device::SoundOutput> output_;  ///< After the mixer, which it plays.
  const SoundPlan::Part* part_ = nullptr;        ///< That is heard.
  std::uint64_t num_asked_ = 0;
  std::int64_t num_lost_ = 0;
  std::deque<AskedCue> asked_;
  std::vector<experiments::PlayedCue> heard_;  ///< And not stored yet.
  bool started_is_told_ = false, is_closed_ = false;
  std::string told_problem_;
};

}  // namespace jnd::app
