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

/// A device whose driver is a shared object of somebody else's, `jnd_device.h`, in a process of
/// its own.
///
/// Each `read` asks the driver for a measurement, by a number one higher than the last one's,
/// and waits for the answer for 0.4 of a tick at most (a simulation without a clock of its own:
/// 0.2 s). Where none comes in time the last measurement stands in, with its old time, which
/// the loop calls stale after 5 ms; a driver that brings too few new ones (more than a tenth
/// missing of the last 256) is called stale as well. So a driver that crashes, hangs, is
/// stopped or ends is a fault, and nothing waits for it. What comes is checked, whatever the
/// driver's process has checked. There is no way back but `close` and `open`, which starts the
/// driver anew, unless the driver answers again.
///
/// A driver that paces the loop is not asked: it measures at its own pace, and `read` takes the
/// newest that came; one that comes within 0.4 of a tick counts, too.
///
/// One thread, as every device; `halt` any.
class PluginDevice final : public HapticDevice {
 public:
  struct Parameters {
    DriverProcess::Parameters process;
    bool believes_simulated = false;  ///< What the driver says of itself.
    double max_stale_s = 0.005;       ///< For which a measurement may stand in, > 0.
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
  /// What the driver says. Real time.
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
  /// The driver answers, and its last measurement was a new one.
  [[nodiscard]] bool may_arm() const noexcept override { return is_well_; }
  void halt() noexcept override { process_.halt(); }

  [[nodiscard]] const Counts& counts() const noexcept { return counts_; }
  /// Its process; -1: none. For tests.
  [[nodiscard]] int process() const noexcept { return process_.process(); }

 private:
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
  bool is_lost_ = false;  ///< The last answer did not come: none is waited for.
  bool is_well_ = false;
  core::Fault fault_ = core::Fault::kNone;
  core::Fault write_fault_ = core::Fault::kNone;  ///< What the driver made of a force.
  DriverRequest request_;
  std::uint64_t taken_number_ = 0;  ///< Of the newest answer.
  std::uint64_t newest_sample_ = 0;
  core::HapticState newest_;
  std::int64_t newest_ns_ = 0;  ///< When it came; 0: there is none.
  Counts counts_;
  static constexpr std::size_t kNumJudged = 256;
  std::bitset<kNumJudged> missing_;  ///< Which of the last answers had nothing new, in a ring.
  std::size_t next_judged_ = 0;
  int num_missing_ = 0;  ///< Of them.
};

/// "plugin:ARGUMENT", in a process of its own or, where the options say so, without one. An
/// empty argument is a device that is there to be listed. Throws as `plugin_options`,
/// `plugin_file` and the constructor above do. Not real time.
[[nodiscard]] std::unique_ptr<HapticDevice> make_plugin_device(std::string_view argument,
                                                               double rate_hz);

/// What the driver of "ARGUMENT" says of its device, which is not opened. Throws as above. Not
/// real time.
[[nodiscard]] jnd_device_description described_plugin(std::string_view argument);

}  // namespace jnd::device
