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
/// how the hand moved in between. The caller lets the time pass. Not real time.
class Presenter {
 public:
  /// The references must outlive this object. `sound` plays the cues at the moments of a
  /// stimulus; nullptr if nobody listens.
  Presenter(Apparatus& apparatus, experiments::Session& session,
            const experiments::DeviceNeeds& needs, SessionSound* sound = nullptr)
      : apparatus_(apparatus), session_(session), needs_(needs), sound_(sound) {}

  /// What is rendered after a presentation has ended.
  enum class Afterwards {
    kSameMedium,  ///< Until the next presentation begins.
    /// At once, so that no hand stays in a medium while the disk works.
    kFreeSpace,
    /// The same medium, until the next step of this stimulus begins: what no force acted in is
    /// told of the stimulus as a whole.
    kNextStep,
  };

  /// What a presentation is to the participant.
  enum class Beginning {
    kStimulus,  ///< A stimulus of its own, or free space.
    /// A step of the stimulus before, which goes on; no cue marks it.
    kStep,
  };

  /// What one presentation was like.
  struct Felt {
    /// The slope of the delivered force against speed, after the ramp; NaN if the presentation
    /// ended before. It comes from the device if the device knows it, or else from what the
    /// loop sent.
    double delivered_damping_n_s_per_m = 0.0;
    /// What the device itself has added since it was opened; 0 if the device does not know it.
    double device_damping_n_s_per_m = 0.0;
    std::int64_t last_tick = 0;
    double duration_s = 0.0;
    /// The ticks that were due since the event of the beginning.
    std::int64_t num_ticks = 0;
    std::int64_t missed_ticks = 0;  ///< The ticks among them that never ran.
  };

  /// Stores that the presentation begins, then switches the medium to "test", "reference" or
  /// "free_space" of the current trial.
  void begin(const experiments::Block& block, const std::string& interval,
             Beginning beginning = Beginning::kStimulus);
  /// Whether `ramp_is_over` has still to be called, and whether it is due because the loop
  /// renders the medium in full.
  [[nodiscard]] bool waits_for_ramp() const;
  [[nodiscard]] bool ramp_has_passed() const;
  /// Begins to measure, because only what comes after the ramp counts as felt.
  void ramp_is_over();
  /// Stores what the presentation was like until now.
  Felt end(Afterwards afterwards = Afterwards::kSameMedium);
  /// Why what was felt does not count, in words for events: more of its ticks never ran than
  /// the study allows. "" if it counts.
  [[nodiscard]] std::string missed_reason(const Felt& felt) const;
  /// Makes the presentation not count, after a fault or a pause. The caller first switches to
  /// free space, because this waits for the disk; it also stores the event that ends the
  /// attempt.
  void abandon();
  /// Stores what the hand was exposed to since the last presentation ended, or since the last
  /// call, and what guards have noticed. It is called after something was given up, and after a
  /// medium was explored. Do not call it before a session has begun or after it is over.
  void tell_exposure();

  [[nodiscard]] bool under_way() const noexcept { return under_way_; }
  /// The time since the medium was switched.
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
  /// As the participant perceives it: from cue to cue.
  bool is_in_stimulus_ = false;
  bool under_way_ = false;
  bool measuring_ = false;
  std::int64_t switched_tick_ = 0;  ///< The first tick that can have been in the medium.
  std::int64_t limited_before_ = 0;
  std::int64_t missed_before_ = 0;
  core::MediumAmounts amounts_;
  core::ContactSums sums_before_;
  /// The stimulus asks for a force, and its ramp was over once: that of its first step.
  bool counts_forces_ = false;
  bool told_missing_force_ = false;  ///< Of this stimulus.
  core::ForceCounts forces_before_;  ///< When that ramp was over.
  std::int64_t ticks_before_ = 0;    ///< Of the loop, likewise.
  core::Exposure told_;              ///< In events of this apparatus.
  core::GuardCounts told_guards_;    ///< In events of this apparatus.
};

}  // namespace jnd::app
