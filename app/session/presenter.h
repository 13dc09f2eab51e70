#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/session/apparatus.h"
#include "app/sound/session_sound.h"
#include "experiments/session/session.h"
#include "experiments/study/study.h"

namespace jnd::app {

/// Presents the stimuli of trials: each from its event to its end, with what was delivered and
/// how the hand moved in between. Whoever uses it lets the time pass. Not real time.
class Presenter {
 public:
  /// The references must outlive it. `sound`: gives the cues of the moments of a stimulus;
  /// nullptr: nobody listens.
  Presenter(Apparatus& apparatus, experiments::Session& session,
            const experiments::DeviceNeeds& needs, SessionSound* sound = nullptr)
      : apparatus_(apparatus), session_(session), needs_(needs), sound_(sound) {}

  /// What is rendered once a presentation has ended.
  enum class Afterwards {
    kSameMedium,  ///< Until the next begins.
    kFreeSpace,   ///< At once: no hand stays in a medium for as long as a disk takes.
  };

  /// What a presentation is to the participant.
  enum class Beginning {
    kStimulus,  ///< One of its own, or free space.
    kStep,      ///< A step of the stimulus before, which goes on: no cue tells of it.
  };

  /// What one presentation came to.
  struct Felt {
    /// Slope of the delivered force on speed, after the ramp; NaN if it ended before. As the
    /// device knows it, or else as the loop sent it.
    double delivered_damping_n_s_per_m = 0.0;
    /// What the device itself has added since it was opened; 0 from one that does not know.
    double device_damping_n_s_per_m = 0.0;
    std::int64_t last_tick = 0;
    double duration_s = 0.0;
    std::int64_t num_ticks = 0;     ///< That were due, from the event of its beginning on.
    std::int64_t missed_ticks = 0;  ///< Ticks among them that never ran.
  };

  /// Stores the presentation's beginning, then switches the medium: "test", "reference" or
  /// "free_space" of the current trial.
  void begin(const experiments::Block& block, const std::string& interval,
             Beginning beginning = Beginning::kStimulus);
  /// Whether `ramp_is_over` is still to come, and whether it is due: the loop renders the
  /// medium in full.
  [[nodiscard]] bool waits_for_ramp() const;
  [[nodiscard]] bool ramp_has_passed() const;
  /// Felt is what comes after the ramp: from here on it is measured.
  void ramp_is_over();
  /// Stores what it came to up to now.
  Felt end(Afterwards afterwards = Afterwards::kSameMedium);
  /// Why what was felt counts for nothing, in words for events: more of its ticks never ran
  /// than the study allows. "" where it counts.
  [[nodiscard]] std::string missed_reason(const Felt& felt) const;
  /// It counts for nothing: a fault, a pause. The event of the attempt's end is the caller's,
  /// and so is free space, first: this waits for the disk.
  void abandon();
  /// Stores what the hand was exposed to since the last presentation that was ended, or since
  /// this: after what was given up, and after a medium that was explored; and what guards have
  /// noticed. Not where the session is not begun yet, or over.
  void tell_exposure();

  [[nodiscard]] bool under_way() const noexcept { return under_way_; }
  /// Since the medium was switched.
  [[nodiscard]] double felt_s() const noexcept;

 private:
  [[nodiscard]] std::optional<core::Exposure> exposure_since_last();
  void tell_guards();
  void tell_missing_force(const core::Telemetry& last);
  void give_cue(experiments::CueMoment moment);
  void stimulus_is_gone();

  [[nodiscard]] const experiments::PresentationState& presentation() const;

  Apparatus& apparatus_;
  experiments::Session& session_;
  const experiments::DeviceNeeds& needs_;
  SessionSound* sound_;
  bool is_in_stimulus_ = false;  ///< As the participant has it: from cue to cue.
  bool under_way_ = false;
  bool measuring_ = false;
  std::int64_t switched_tick_ = 0;  ///< The first that can have been in the medium.
  std::int64_t limited_before_ = 0;
  std::int64_t missed_before_ = 0;
  core::MediumAmounts amounts_;
  core::ContactSums sums_before_;
  core::ForceCounts forces_before_;
  std::int64_t ticks_before_ = 0;  ///< Of the loop, when the ramp was over.
  core::Exposure told_;            ///< In events of this apparatus.
  core::GuardCounts told_guards_;  ///< In events of this apparatus.
};

}  // namespace jnd::app
