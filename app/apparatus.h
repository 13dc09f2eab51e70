#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "analysis/movement/strokes.h"
#include "core/clock.h"
#include "core/haptic_command.h"
#include "core/storage/storage_thread.h"
#include "core/storage/study_store.h"
#include "core/telemetry.h"
#include "device/realtime_thread.h"
#include "device/stroking_arm.h"
#include "experiments/participants/laboratory.h"

namespace jnd::app {

/// A simulated hand, its haptic loop and where the samples go, driven as one: commands in, time
/// passes, what was felt and how the hand moved comes out. Not real time itself.
class Apparatus {
 public:
  struct Parameters {
    double rate_hz = 1000.0;
    double ramp_s = 0.050;
    core::Immersion immersion;
    double home_height_m = -0.15;    ///< Of the hand at rest, workspace frame.
    std::int64_t first_tick = 0;     ///< A resumed session counts on.
    std::int64_t first_time_ns = 0;  ///< Of the simulated clock, likewise.
    bool realtime = false;           ///< Paced by a real-time thread; else as fast as it goes.
    bool allow_no_realtime = false;  ///< A real device also without real-time rights.
    /// Where samples are recorded; none: strokes are summed up, nothing else is kept.
    std::optional<std::filesystem::path> recording;
    core::Durability durability = core::Durability::kEveryCommit;
  };

  /// Throws `Error` if the loop or the recording cannot be set up.
  Apparatus(const Parameters& parameters, const experiments::Laboratory& laboratory);
  ~Apparatus();
  Apparatus(const Apparatus&) = delete;
  Apparatus& operator=(const Apparatus&) = delete;

  /// Changes the medium by a ramp.
  void render(const core::MediumAmounts& medium);
  void begin_strokes(const device::StrokePlan& plan, const core::RandomStream& random);
  void go_home();
  /// Whole strokes since the last `begin_strokes`.
  [[nodiscard]] std::int64_t strokes_finished() const noexcept;

  /// Lets this much time pass. Throws `Error` if the loop latched a fault.
  void run_for(double duration_s);

  /// Number of the next sample.
  [[nodiscard]] std::int64_t next_tick() const noexcept;
  [[nodiscard]] const core::Telemetry& telemetry() const noexcept;
  /// Strokes from now on until `finish_strokes`.
  void meter_strokes();
  [[nodiscard]] analysis::StrokeSummary finish_strokes();
  /// The recording up to the commit's last tick is on disk before the commit is, and both are
  /// when this returns.
  void commit(core::StudyStore& store, const core::Commit& commit);
  /// What the real-time thread was given and how punctual it has been; none if simulated.
  [[nodiscard]] const device::RealtimeThread* realtime_thread() const noexcept;
  /// "simulated", or the real-time policy and memory lock that were obtained.
  [[nodiscard]] std::string realtime() const;
  [[nodiscard]] const core::Clock& clock() const noexcept;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace jnd::app
