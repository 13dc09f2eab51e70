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

/// The output of a session's sound.
struct SoundChoice {
  /// "" for the machine's own output, "off" for none, or else a name.
  std::string output{};
  SoundSettings settings{};  ///< The settings of this machine.
  /// Opens an output; if empty, ALSA does.
  device::OpenSoundOutput open{};
};

/// What a participant hears in a session: noise as the study or the block defines it, and cues.
/// It plays on a thread of its output; the session's thread controls it and stores what it
/// reports. A problem with sound never ends a session: it is told, stored, and the output is
/// tried again when somebody asks for it. Used by one thread; not real time except for `cue`.
class SessionSound {
 public:
  struct Parameters {
    const experiments::Study& study;
    SoundChoice choice;
    /// The session's seed; it makes the noise, which says nothing about trials.
    std::uint64_t seed = 0;
  };

  /// Opens the output if the study has sound; it is silent until `play`. The study must outlive
  /// this object.
  explicit SessionSound(const Parameters& parameters);
  /// Fades out first if it plays.
  ~SessionSound();
  SessionSound(const SessionSound&) = delete;
  SessionSound& operator=(const SessionSound&) = delete;

  /// Why the study's sound is not heard, in a sentence; "" if it is heard, or if the study has
  /// none.
  [[nodiscard]] std::string problem() const;
  /// What an experimenter has to know: the problem, or gaps; "" if all is well.
  [[nodiscard]] std::string warning() const;
  /// Opens the output again after a failure. Does nothing if it plays, or is off.
  void try_again();
  /// Throws `Error` if the study requires sound and there is none.
  void require_heard() const;

  /// Plays what is to be heard in this block, or with nullptr outside of blocks, from the next
  /// samples on, with the noise's ramp. Does nothing if that is heard already.
  void play(const experiments::Block* block);
  /// Requests the cue of a moment if the block has one. `presentation` counts from 1 in the
  /// attempt, or is 0. Real time, except that it writes a note for itself.
  void cue(experiments::CueMoment moment, std::int64_t trial, std::int64_t attempt,
           std::int64_t presentation);

  /// Stores that the sound plays, or why it no longer does, and the cues that were heard. Waits
  /// for the disk.
  void follow(experiments::Session& session);
  /// Stores how the sound has been.
  void measure(experiments::Session& session);
  /// Fades out, and stores what is left. Call it once.
  void close(experiments::Session& session);

 private:
  void open() noexcept;
  void fade_out() noexcept;
  void collect_cues();
  [[nodiscard]] device::SoundOutputState state() const;

  /// A cue that was requested and whose playing was not yet reported.
  struct AskedCue {
    std::uint64_t id = 0;
    experiments::PlayedCue cue;
  };

  Parameters parameters_;
  bool has_sound_;
  std::string output_name_;
  std::string open_problem_;  ///< Why the output could not be opened.
  std::optional<SoundCalibration> calibration_;
  SoundPlan plan_;
  std::unique_ptr<core::SoundMixer> mixer_;
  /// Declared after the mixer, because it plays the mixer.
  std::unique_ptr<device::SoundOutput> output_;
  const SoundPlan::Part* part_ = nullptr;  ///< The part that is heard.
  std::uint64_t num_asked_ = 0;
  std::int64_t num_lost_ = 0;
  std::deque<AskedCue> asked_;
  std::vector<experiments::PlayedCue> heard_;  ///< Cues that were heard but not stored yet.
  bool started_is_told_ = false, is_closed_ = false;
  std::string told_problem_;
};

}  // namespace jnd::app
