#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/session/apparatus.h"
#include "app/session/session_pulses.h"
#include "app/session/session_streams.h"
#include "app/sound/session_sound.h"
#include "core/safety/fault.h"
#include "core/storage/study_store.h"
#include "experiments/session/session.h"
#include "experiments/study/study.h"

namespace jnd::app {

using core::StorageError;

/// A stored session with its apparatus, from start or resumption to its end or interruption. It
/// is what sessions of simulated participants and of operators have in common. Not thread-safe,
/// not real time.
class RunningSession {
 public:
  struct Parameters {
    core::StudyStore& store;
    std::int64_t session = 0;  ///< The store already has the session's row.
    const experiments::Study& study;
    /// Device, real time and exchange. What the study and the session's log decide is filled
    /// in.
    Apparatus::Parameters apparatus;
    /// The laboratory of a simulated hand, if any.
    const experiments::Laboratory* laboratory = nullptr;
    /// Called after the event's commit; may be empty.
    std::function<void(const core::EventRow&)> on_event;
    /// The session is resumed only to be ended, so nothing more is felt.
    bool only_ends = false;
    /// Streams to and from other recorders, in real time; none unless asked for.
    WantedStreams streams{};
    /// The output of the study's sound. Without it, nobody listens, and nothing is played or
    /// stored.
    std::optional<SoundChoice> sound{};
    /// Pulses to another recorder, in real time; none unless asked for.
    WantedMarkers markers{};
  };

  /// Replays the log and starts the apparatus with the device profile that the session stores.
  /// Throws `Error`, also for a real device without a profile that has to give force.
  explicit RunningSession(const Parameters& parameters);
  RunningSession(const RunningSession&) = delete;
  RunningSession& operator=(const RunningSession&) = delete;

  [[nodiscard]] Apparatus& apparatus() noexcept { return apparatus_; }
  [[nodiscard]] const Apparatus& apparatus() const noexcept { return apparatus_; }
  [[nodiscard]] experiments::Session& session() noexcept { return session_; }
  [[nodiscard]] const experiments::Study& study() const noexcept { return parameters_.study; }

  /// Starts the session in this language, or resumes it by "repeat", "restart" or "end".
  void begin(const std::string& choice, const std::string& language = "");
  /// Stores how the device was fitted to the person, in people's words by what was fitted, with
  /// the points that hold the hand and their places now. Call it before the first stage, at
  /// rest.
  void keep_fitting(const std::map<std::string, std::string>& fitting);
  /// Stores how punctual the loop has been since it started. It is called after every stage, so
  /// that a crash loses at most one stage's timing.
  void keep_timing();
  /// Stores whether there may be force, if that has changed since it was last stored. `by` says
  /// who armed a real device. Does nothing in simulated time.
  void keep_arming(const std::string& by);
  /// Stores the fault that the loop has latched, and the last second before it; does nothing if
  /// there is none.
  void keep_fault();
  /// Stores what there is to tell about streams; call it now and then. Does nothing if none
  /// were asked for.
  void follow_streams();
  /// Stores what there is to tell about pulses; their times are stored while nothing is felt.
  void follow_markers();
  /// Why there are no pulses any more; "" as long as there are, and if none were asked for.
  [[nodiscard]] std::string markers_problem() const;
  /// Ends the recording of other streams, and the pulses, before the session ends or the
  /// program leaves it.
  void close_streams();
  /// What the participant hears; nullptr if nobody listens.
  [[nodiscard]] SessionSound* sound() noexcept { return sound_.get(); }
  [[nodiscard]] const SessionSound* sound() const noexcept { return sound_.get(); }
  /// Stores what there is to tell about the sound; call it now and then, while nothing is felt.
  void follow_sound();
  /// Fades the sound out and stores what is left, at the same time as `close_streams`.
  void close_sound();

 private:
  /// Events go through the apparatus, which puts the recording on disk first.
  class StoredLog final : public experiments::EventLog {
   public:
    explicit StoredLog(RunningSession& running) : running_(running) {}
    void append(const core::Commit& commit) override;

   private:
    RunningSession& running_;
  };

  [[nodiscard]] Apparatus::Parameters apparatus_parameters() const;
  [[nodiscard]] std::unique_ptr<SessionStreams> streams_asked_for() const;
  [[nodiscard]] std::unique_ptr<SessionSound> sound_asked_for() const;
  [[nodiscard]] std::unique_ptr<SessionPulses> pulses_asked_for() const;

  Parameters parameters_;
  bool recorded_samples_;
  std::vector<core::EventRow> history_;
  std::int64_t recorded_tick_;
  std::unique_ptr<SessionStreams> streams_;  ///< nullptr if none were asked for.
  std::unique_ptr<SessionSound> sound_;      ///< nullptr if nobody listens.
  std::unique_ptr<SessionPulses> pulses_;    ///< nullptr if none were asked for.
  Apparatus apparatus_;
  std::optional<core::Arming> told_arming_;
  StoredLog log_{*this};
  experiments::Session session_;
};

}  // namespace jnd::app
