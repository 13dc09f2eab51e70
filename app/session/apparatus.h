#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/profile/known_profile.h"
#include "app/session/operator_exchange.h"
#include "core/clock.h"
#include "core/exchange/haptic_command.h"
#include "core/exchange/telemetry.h"
#include "core/media/force_map.h"
#include "core/storage/storage_thread.h"
#include "core/storage/study_store.h"
#include "device/fault_injection.h"
#include "device/realtime_thread.h"
#include "device/stroking_arm.h"
#include "experiments/participants/laboratory.h"
#include "experiments/session/event.h"

namespace jnd::app {

/// A device, its haptic loop and the place where samples go, driven as one: commands go in,
/// time passes, and what was felt and how the hand moved comes out. The hand is moved by a
/// simulated arm ("lumped", in real time or as fast as possible) or by a person, in real time.
/// Not real time itself; used by one thread.
class Apparatus {
 public:
  struct Parameters {
    std::string device = "lumped";  ///< A name in the registry of devices.
    /// What was measured of the device; with nullptr, the device is used as it describes
    /// itself.
    std::shared_ptr<const KnownProfile> profile;
    /// If true, a real device without a profile is not even opened.
    bool wants_profile = false;
    double rate_hz = 1000.0;
    double ramp_s = 0.050;
    core::Immersion immersion;
    /// Felt in addition to every medium: the walls of a container.
    core::MediumAmounts surroundings;
    std::shared_ptr<const core::ForceMap> force_map;  ///< With nullptr, the fit of the thesis.
    /// The height of the resting hand, in the workspace frame.
    double home_height_m = -0.15;
    /// A resumed session continues to count.
    std::int64_t first_tick = 0;
    /// The simulated clock continues as well.
    std::int64_t first_time_ns = 0;
    /// A real-time thread paces the loop; otherwise it runs as fast as possible.
    bool realtime = false;
    /// A real device may run without real-time rights.
    bool allow_no_realtime = false;
    /// Arms a real device at once, as somebody beside it has asked for. A simulated device
    /// starts armed.
    bool arm = false;
    /// Called when all else is well and a real device is about to be armed; may be empty.
    std::function<void()> before_arming = {};
    /// The loop's guards only count what they would have done; see `device::HapticLoop`.
    bool shadow_guards = false;
    /// Where samples are recorded. Without it, strokes are summarised, and nothing else is
    /// stored.
    std::optional<std::filesystem::path> recording;
    core::Durability durability = core::Durability::kEveryCommit;
    /// Of a window, which then beats the heartbeat and keeps them alive; and whoever leads the
    /// session has to look at the telemetry every second, else the force fades. nullptr:
    /// `run_for` and whatever waits for the disk beat it.
    OperatorExchange* exchange = nullptr;
    /// Faults of the device, at ticks counted from its start, for tests and rehearsals.
    std::vector<device::ScheduledFault> injected_faults;
    /// Called for every sample, in order, by the thread that stores samples; in simulated time,
    /// by the one that calls `run_for`. May be empty.
    std::function<void(const core::Sample&)> on_sample;
  };

  /// Uses a device with its default settings: "mouse", or a real one. Throws `Error` if device,
  /// loop or recording cannot be set up, or if the profile belongs to another device; then no
  /// force was sent at all.
  explicit Apparatus(const Parameters& parameters);
  /// Uses the lumped hand and the limits of this laboratory; other devices take its limits
  /// only.
  Apparatus(const Parameters& parameters, const experiments::Laboratory& laboratory);
  ~Apparatus();
  Apparatus(const Apparatus&) = delete;
  Apparatus& operator=(const Apparatus&) = delete;

  /// What a medium is to what was felt before.
  enum class Stimulus {
    kAnother,
    kGoesOn,  ///< A step of it: what it may give back is granted once, however many steps.
  };
  /// Changes the medium by a ramp.
  void render(const core::MediumAmounts& medium, Stimulus stimulus = Stimulus::kAnother);
  // Of the simulated arm; a hand that a person moves takes no orders.
  void begin_strokes(const device::StrokePlan& plan, const core::RandomStream& random);
  void go_home();
  /// On a simulated hand, puts fingers back that came off; a person does that for a person.
  void put_fingers_back();
  /// The whole strokes since the last `begin_strokes`. For a hand that ignores it, the whole
  /// strokes since `meter_strokes`.
  [[nodiscard]] std::int64_t strokes_finished() const noexcept;

  /// Lets this much time pass. Throws `Error` if the loop has latched a fault.
  void run_for(double duration_s);

  /// Asks for the force, faded in from zero: at first, after a stop that was released, or a
  /// fault. Telemetry tells whether it came: what is still wrong latches again.
  /// `num_faults_seen`: as whoever asks saw it in the telemetry; see `device::HapticLoop`.
  void rearm(std::uint64_t num_faults_seen);
  /// No force until `rearm`.
  void disarm();

  /// The last second before the fault that the loop has latched, with the fault's tick last;
  /// empty if there is no fault. Call it before `rearm`.
  [[nodiscard]] std::vector<core::Sample> flight_record() const;

  /// The number of the next sample.
  [[nodiscard]] std::int64_t next_tick() const noexcept;
  [[nodiscard]] const core::Telemetry& telemetry() const noexcept;
  [[nodiscard]] bool is_simulated() const noexcept;
  [[nodiscard]] bool shadows_guards() const noexcept;
  /// True for the laboratory's own lumped hand, which is no device with mechanics of its own.
  [[nodiscard]] bool is_laboratory_hand() const noexcept;
  /// The number of contact points that the device declares.
  [[nodiscard]] int num_contact_points() const noexcept;
  [[nodiscard]] core::ShareRatios share_ratio() const noexcept;
  /// A fault of the loop in words, with what the device's own program said about it, if
  /// anything.
  [[nodiscard]] std::string fault_words(core::Fault fault) const;
  /// True if the device's own sensors measure force.
  [[nodiscard]] bool measures_force() const noexcept;
  /// What the device says about itself, whatever its profile changes, for storing. Not real
  /// time.
  [[nodiscard]] experiments::DeviceTold device_told() const;
  /// The greatest force that all points together can get: the least of the limiter's and the
  /// device's limits.
  [[nodiscard]] double max_total_force_n() const noexcept;
  /// Meters strokes from now on until `finish_strokes`.
  void meter_strokes();
  /// The whole strokes since `meter_strokes`, as far as samples were taken; 0 if none are
  /// metered. Any thread may call it.
  [[nodiscard]] int num_metered_strokes() const noexcept;
  /// How the hand moved since `meter_strokes`; see `MovementMeter`.
  [[nodiscard]] core::PresentationMeasures finish_strokes();
  /// What was sent during the last metered strokes, for devices that do not know what their
  /// hand felt. It contains only the rendered force.
  [[nodiscard]] const core::ContactSums& metered_sums() const noexcept;
  /// Puts the recording on disk up to the commit's last tick, and then the commit. Both are on
  /// disk when this returns.
  void commit(core::StudyStore& store, const core::Commit& commit);
  /// What the real-time thread was granted, and how punctual it has been; nullptr in simulated
  /// time.
  [[nodiscard]] const device::RealtimeThread* realtime_thread() const noexcept;
  /// "simulated", or the real-time policy and memory lock that were obtained.
  [[nodiscard]] std::string realtime() const;
  [[nodiscard]] const core::Clock& clock() const noexcept;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace jnd::app
