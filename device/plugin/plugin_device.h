#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "device/haptic_device.h"
#include "device/plugin/driver_description.h"
#include "device/plugin/driver_process.h"

namespace jnd::device {

/// A device whose driver is somebody else's shared object (`jnd_device.h`), in a process of its
/// own.
///
/// Each `read` asks the driver for a measurement, by a number one higher than the last one's,
/// and waits for the answer for at most 0.4 of a tick (for a simulation without a clock of its
/// own: 0.2 s). If none comes in time, the last measurement is reused with its old time, which
/// the loop calls stale after 5 ms. A driver with too few new measurements (more than a tenth
/// missing of the last 256) is called stale as well. So a driver that crashes, hangs, is
/// stopped or ends is a fault, and nothing waits for it. Everything received is checked again,
/// whatever the driver's process has checked. Unless the driver answers again, the only way
/// back is `close` and `open`, which restarts the driver.
///
/// A driver that paces the loop is not asked. It measures at its own pace, and `read` takes the
/// newest measurement, also one that comes within 0.4 of a tick.
///
/// One thread may use it, as with every device. Any thread may call `halt`.
class PluginDevice final : public HapticDevice {
 public:
  struct Parameters {
    DriverProcess::Parameters process;
    /// Whether to believe the driver that nobody can be hurt.
    bool believes_simulated = false;
    double max_stale_s = 0.005;  ///< How long a measurement may be reused, > 0.
  };

  /// Counts since it was opened.
  struct Counts {
    std::uint64_t num_reads = 0;
    std::uint64_t num_late = 0;      ///< Reads whose answer did not come in time.
    std::uint64_t num_repeated = 0;  ///< Answers without a new measurement.
  };

  /// Asks the driver to describe its device. Throws `DeviceUnreachable`, and `core::Error` for
  /// a rate that its device cannot do. Not real time.
  explicit PluginDevice(const Parameters& parameters);

  [[nodiscard]] std::string_view name() const noexcept override { return "plugin"; }
  [[nodiscard]] DeviceCapabilities capabilities() const noexcept override;
  /// Returns the driver's description. Real time.
  [[nodiscard]] const jnd_device_description& description() const noexcept {
    return description_;
  }

  [[nodiscard]] DeviceIdentity identity() const override { return identity_of(description_); }

  void open() override;
  [[nodiscard]] bool wait_for_sample(std::int64_t deadline_ns) noexcept override;
  [[nodiscard]] bool read(core::HapticState& state) noexcept override;
  [[nodiscard]] bool write(const core::PointVectors& force_on_hand_n) noexcept override;
  void close() noexcept override;
  [[nodiscard]] core::Fault fault() const noexcept override { return fault_; }
  [[nodiscard]] std::string words_of_fault() const override;
  [[nodiscard]] bool answers() const override { return words_of_silence().empty(); }
  /// Whether the driver answers and its last measurement was a new one.
  [[nodiscard]] bool may_arm() const noexcept override { return is_well_; }
  void halt() noexcept override { process_.halt(); }

  [[nodiscard]] const Counts& counts() const noexcept { return counts_; }
  /// Returns its process, or -1 if there is none. For tests.
  [[nodiscard]] int process() const noexcept { return process_.process(); }

 private:
  [[nodiscard]] std::string words_of_silence() const;
  [[nodiscard]] bool receive(std::int64_t deadline_ns, DriverAnswer& answer) noexcept;
  [[nodiscard]] bool take(const DriverAnswer& answer) noexcept;
  [[nodiscard]] bool stand_in(core::HapticState& state, std::int64_t now_ns) noexcept;
  bool fail(core::Fault fault) noexcept;
  void count_newness(bool is_new) noexcept;

  Parameters parameters_;
  DriverProcess process_;
  jnd_device_description description_{};
  bool is_open_ = false;
  bool has_own_clock_ = true;
  bool paces_loop_ = false;
  bool is_lost_ = false;  ///< The last answer did not come, so no answer is waited for.
  bool is_well_ = false;
  core::Fault fault_ = core::Fault::kNone;
  core::Fault write_fault_ = core::Fault::kNone;  ///< The driver's result for a force.
  DriverRequest request_;
  std::uint64_t taken_number_ = 0;  ///< Number of the newest answer.
  std::uint64_t newest_sample_ = 0;
  core::HapticState newest_;
  std::int64_t newest_ns_ = 0;  ///< When it came; 0 if there is none.
  Counts counts_;
  static constexpr std::size_t kNumJudged = 256;
  std::bitset<kNumJudged> missing_;  ///< Which of the last answers had nothing new, in a ring.
  std::size_t next_judged_ = 0;
  int num_missing_ = 0;  ///< Number of those answers.
};

/// Makes "plugin:ARGUMENT", in a process of its own, or without one if the options say so. An
/// empty argument gives a device that only serves to be listed. Throws like `plugin_options`,
/// `plugin_file` and the constructor above. Not real time.
[[nodiscard]] std::unique_ptr<HapticDevice> make_plugin_device(std::string_view argument,
                                                               double rate_hz);

/// Returns the description from the driver of "ARGUMENT", whose device is not opened. Throws
/// like the function above. Not real time.
[[nodiscard]] jnd_device_description described_plugin(std::string_view argument);

}  // namespace jnd::device
