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

/// A device, its haptic loop and where the samples go, driven as one: commands in, time passes,
/// what was felt and how the hand moved comes out. The hand is moved by a simulated arm
/// ("lumped", in real time or as fast as it goes) or by a person, in real time. Not real time
/// itself; used by one thread.
class Apparatus {
 public:
  struct Parameters {
    std::string device = "lumped";  ///< A name in the registry of devices.
    /// What was measured of it; nullptr: it is used as it says that it is.
    std::shared_ptr<const KnownProfile> profile;
    /// A real device is not even opened without one.
    bool wants_profile = false;
    double rate_hz = 1000.0;
    double ramp_s = 0.050;
    core::Immersion immersion;
    core::MediumAmounts surroundings;  ///< Felt besides every medium: a container's walls.
    std::shared_ptr<const core::ForceMap> force_map;  ///< nullptr: the thesis's fit.
    double home_height_m = -0.15;                     ///< Of the hand at rest, workspace frame.
    std::int64_t first_tick = 0;                      ///< A resumed session counts on.
    std::int64_t first_time_ns = 0;                   ///< The simulated clock counts on, too.
    bool realtime = false;           ///< Paced by a real-time thread; else as fast as it goes.
    bool allow_no_realtime = false;  ///< A real device also without real-time rights.
    /// A real device is armed at once, as somebody asked for who is beside it. A simulated one
    /// starts armed.
    bool arm = false;
    /// Guards of the loop only count what they would have done; see `device::HapticLoop`.
    bool shadow_guards = false;
    /// Where samples are recorded; none: strokes are summed up, nothing else is kept.
    std::optional<std::filesystem::path> recording;
    core::Durability durability = core::Durability::kEveryCommit;
    /// Of a window, which then beats the heartbeat and keeps them alive; and whoever leads the
    /// session has to look at the telemetry every second, else the force fades. nullptr:
    /// `run_for` and whatever waits for the disk beat it.
    OperatorExchange* exchange = nullptr;
    /// What goes wrong with the device, at ticks counted from its start: for tests and
    /// rehearsals.
    std::vector<device::ScheduledFault> injected_faults;
    /// Called for every sample, in order, by the thread that stores them; simulated, by the one
    /// that calls `run_for`. May be empty.
    std::function<void(const core::Sample&)> on_sample;
  };

  /// A device with its default settings: "mouse", or a real one. Throws `Error` if device, loop
  /// or recording cannot be set up, or the device is not the one of the profile: then not one
  /// force was sent.
  explicit Apparatus(const Parameters& parameters);
  /// The lumped hand and the limits of this laboratory; other devices take the limits alone.
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
  /// Puts fingers that came off back, on a simulated hand; a person's are put back by a person.
  void put_fingers_back();
  /// Whole strokes since the last `begin_strokes`; of a hand that takes no orders, those since
  /// `meter_strokes`.
  [[nodiscard]] std::int64_t strokes_finished() const noexcept;

  /// Lets this much time pass. Throws `Error` if the loop latched a fault.
  void run_for(double duration_s);

  /// Asks for the force, faded in from zero: at first, after a stop that was released, or a
  /// fault. Telemetry tells whether it came: what is still wrong latches again.
  /// `num_faults_seen`: as whoever asks saw it in the telemetry; see `device::HapticLoop`.
  void rearm(std::uint64_t num_faults_seen);
  /// No force until `rearm`.
  void disarm();

  /// The last second before the fault that the loop has latched, the fault's tick last; empty
  /// without one. Before `rearm`.
  [[nodiscard]] std::vector<core::Sample> flight_record() const;

  /// Number of the next sample.
  [[nodiscard]] std::int64_t next_tick() const noexcept;
  [[nodiscard]] const core::Telemetry& telemetry() const noexcept;
  [[nodiscard]] bool is_simulated() const noexcept;
  [[nodiscard]] bool shadows_guards() const noexcept;
  /// The laboratory's own lumped hand, and no device with mechanics of its own.
  [[nodiscard]] bool is_laboratory_hand() const noexcept;
  /// That the device declares.
  [[nodiscard]] int num_contact_points() const noexcept;
  [[nodiscard]] core::ShareRatios share_ratio() const noexcept;
  /// A fault of the loop, with what the device's own program said of it, if it did.
  [[nodiscard]] std::string fault_words(core::Fault fault) const;
  /// By sensors of its own.
  [[nodiscard]] bool measures_force() const noexcept;
  /// What the device says of itself, whatever its profile does, for keeping. Not real time.
  [[nodiscard]] experiments::DeviceTold device_told() const;
  /// The most that the points together ever get: the least of the limiter's and the device's.
  [[nodiscard]] double max_total_force_n() const noexcept;
  /// Strokes from now on until `finish_strokes`.
  void meter_strokes();
  /// Whole strokes since `meter_strokes`, as far as samples have been taken; 0 while none are
  /// metered. Any thread.
  [[nodiscard]] int num_metered_strokes() const noexcept;
  /// How the hand moved since `meter_strokes`; see `MovementMeter`.
  [[nodiscard]] core::PresentationMeasures finish_strokes();
  /// What was sent while the strokes finished last were metered, for devices that do not know
  /// what their hand has been through: nothing but the rendered force is in it.
  [[nodiscard]] const core::ContactSums& metered_sums() const noexcept;
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
