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

/// A stored session with its apparatus, from start or resumption to its end or interruption:
/// what a simulated participant and an operator have in common. Not thread-safe, not real time.
class RunningSession {
 public:
  struct Parameters {
    core::StudyStore& store;
    std::int64_t session = 0;  ///< Its row is in the store already.
    const experiments::Study& study;
    /// Device, real time and exchange; what the study and the session's log decide is filled
    /// in.
    Apparatus::Parameters apparatus;
    const experiments::Laboratory* laboratory =
        nullptr;  ///< That of a simulated hand; or none.
    std::function<void(const core::EventRow&)> on_event;  ///< After its commit; may be empty.
    bool only_ends = false;   ///< It is resumed to be ended: nothing is felt any more.
    WantedStreams streams{};  ///< To and of other recorders, in real time; none unless asked.
    /// Where the study's sound goes to; none: nobody listens, and nothing is played or stored.
    std::optional<SoundChoice> sound{};
    WantedMarkers markers{};  ///< To another recorder by pulses, likewise.
  };

  /// Replays the log and starts the apparatus, by the profile of the device that the session
  /// keeps. Throws `Error`, also for a real device without one that is to give force.
  explicit RunningSession(const Parameters& parameters);
  RunningSession(const RunningSession&) = delete;
  RunningSession& operator=(const RunningSession&) = delete;

  [[nodiscard]] Apparatus& apparatus() noexcept { return apparatus_; }
  [[nodiscard]] const Apparatus& apparatus() const noexcept { return apparatus_; }
  [[nodiscard]] experiments::Session& session() noexcept { return session_; }
  [[nodiscard]] const experiments::Study& study() const noexcept { return parameters_.study; }

  /// Starts the session in this language, or goes on with it: "repeat", "restart" or "end".
  void begin(const std::string& choice, const std::string& language = "");
  /// Stores how the device was fitted to the person, in people's words by what was fitted, with
  /// the points that are held and where they are now: before the first stage, at rest.
  void keep_fitting(const std::map<std::string, std::string>& fitting);
  /// Stores how punctual the loop has been since it was started; after every stage, so that a
  /// crash costs one.
  void keep_timing();
  /// Stores whether there may be force, where that has changed since it was told last; `by`:
  /// who armed a real device. Nothing in simulated time.
  void keep_arming(const std::string& by);
  /// Stores the fault that the loop has latched, and the last second before it; does nothing
  /// without one.
  void keep_fault();
  /// Stores what there is to say of streams; every now and then. Nothing where none was asked
  /// for.
  void follow_streams();
  /// The same of pulses, whose times are stored while nothing is felt.
  void follow_markers();
  /// Why there are no pulses any more; "" as long as there are, and where none were asked for.
  [[nodiscard]] std::string markers_problem() const;
  /// Ends what is recorded of others, and pulses: before the session ends, or its program
  /// leaves it.
  void close_streams();
  /// What the participant hears; nullptr where nobody listens.
  [[nodiscard]] SessionSound* sound() noexcept { return sound_.get(); }
  [[nodiscard]] const SessionSound* sound() const noexcept { return sound_.get(); }
  /// Stores what there is to say of the sound; every now and then, while nothing is felt.
  void follow_sound();
  /// Fades the sound out, and stores the last of it: as `close_streams`.
  void close_sound();

 private:
  /// Events go through the apparatus, which syncs the recording first.
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
  std::unique_ptr<SessionStreams> streams_;  ///< nullptr where none was asked for.
  std::unique_ptr<SessionSound> sound_;      ///< nullptr where nobody listens.
  std::unique_ptr<SessionPulses> pulses_;    ///< Likewise.
  Apparatus apparatus_;
  std::optional<core::Arming> told_arming_;
  StoredLog log_{*this};
  experiments::Session session_;
};

}  // namespace jnd::app
