#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cmath>

#include "core/media/medium.h"
#include "device/haptic_loop.h"
#include "force_dimension/twin_page.h"
#include "plugin_fixture.h"

namespace jnd::device {

/// The driver of Force Dimension's devices with a twin of their library, which sees every force
/// that it is given. Both are built as an outsider would build them.
class ForceDimensionTest : public PluginTest {
 protected:
  static void SetUpTestSuite() {
    PluginTest::SetUpTestSuite();
    page_file_ = std::make_unique<test_support::TemporaryFolder>();
    const std::string name = (page_file_->path() / "twin").string();
    const int file = ::open(name.c_str(), O_RDWR | O_CREAT, 0600);
    ASSERT_GE(file, 0);
    ASSERT_EQ(::ftruncate(file, sizeof(twin_page)), 0);
    void* memory =
        ::mmap(nullptr, sizeof(twin_page), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    ::close(file);
    ASSERT_NE(memory, MAP_FAILED);
    page_ = static_cast<twin_page*>(memory);
    ::setenv("FORCE_DIMENSION_TWIN", name.c_str(), 1);
  }
  static void TearDownTestSuite() {
    ::unsetenv("FORCE_DIMENSION_TWIN");
    ::munmap(page_, sizeof(twin_page));
    page_file_.reset();
    PluginTest::TearDownTestSuite();
  }
  /// Sets up an omega.3 in a hand that strokes, as a simulation by its maker.
  void SetUp() override {
    PluginTest::SetUp();
    twin_page fresh{};
    fresh.version[0] = 3;
    fresh.version[1] = 16;
    fresh.num_devices = fresh.num_available = 1;
    fresh.type = 33;
    fresh.serial = 11311;
    fresh.is_virtual = 1;
    fresh.has_power = fresh.has_watchdog = fresh.has_gravity_compensation = 1;
    fresh.watchdog_step_s = 4e-3;  // A busy machine is no fault of a driver.
    fresh.is_calibrated = fresh.is_wrist_calibrated = 1;
    fresh.calibrates_after_ms = -1;
    fresh.limit_n = 12.0;
    fresh.held_m[2] = -0.03;  // The hand is in the fluid.
    fresh.stroke_m = 0.04;
    for (int i = 0; i < 3; ++i) fresh.rotation[i][i] = 1.0;
    *page_ = fresh;
  }
  /// This holds whatever else a test is about.
  void TearDown() override {
    EXPECT_EQ(page().num_unsafe, 0) << "the first is number " << page().first_unsafe;
  }

  static twin_page& page() { return *page_; }
  static double force_at_twin_n() {
    double squared = 0.0;
    for (const double axis_n : page().force_n) squared += axis_n * axis_n;
    return std::sqrt(squared);
  }

  static std::filesystem::path driver() {
    return built_of(test_support::source_folder() / "device" / "plugin" / "force_dimension",
                    "*.c", "force_dimension", "-ldl -lm");
  }
  static std::filesystem::path twin(const std::string& definition = "") {
    return built_of(test_support::source_folder() / "tests/device/plugin/force_dimension",
                    "twin_dhd.c", "libdhd" + definition, "-lm -lpthread",
                    definition.empty() ? "" : "-D" + definition);
  }
  static std::string argument(const std::string& options = "",
                              const std::string& definition = "") {
    return driver().string() + (page().is_virtual != 0 ? ":simulated" : ":real") +
           ",library=" + twin(definition).string() + options;
  }
  static std::string why_not_with(const std::string& options = "",
                                  const std::string& definition = "") {
    return why_not(argument(options, definition));
  }

 private:
  static std::filesystem::path built_of(const std::filesystem::path& folder,
                                        const std::string& sources, const std::string& name,
                                        const std::string& libraries,
                                        const std::string& more = "") {
    const std::filesystem::path made = page_file_->path() / (name + ".so");
    if (std::filesystem::exists(made)) return made;
    const std::filesystem::path header = page_file_->path() / "include" / "jnd_device.h";
    std::filesystem::create_directories(header.parent_path());
    std::filesystem::copy_file(
        test_support::source_folder() / "device" / "plugin" / "jnd_device.h", header,
        std::filesystem::copy_options::overwrite_existing);
    const std::string command = "cd '" + folder.string() +
                                "' && cc -std=c11 -O1 -Wall -Wextra -Werror -shared -fPIC " +
                                more + " -I '" + header.parent_path().string() + "' " +
                                sources + " " + libraries + " -o '" + made.string() + "'";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    return made;
  }

  static inline std::unique_ptr<test_support::TemporaryFolder> page_file_;
  static inline twin_page* page_ = nullptr;
};

/// Runs a loop as in a session, with a viscous fluid all around a hand that strokes through it.
class StrokedFluid {
  static constexpr std::chrono::milliseconds kTick{1};

 public:
  explicit StrokedFluid(HapticDevice& device)
      : device_(device),
        // On a busy machine the twin moves in jumps. These tests are not about jumps.
        loop_({.starts_armed = device.capabilities().simulated,
               .shadows_guards = true,
               .max_jump_m = 0.1},
              device, {commands_, telemetry_, stop_}) {
    commands_.publish({.sequence = 1,
                       .medium = core::viscous({.viscosity_pa_s = 20.0}),
                       .immersion = {.radius_m = 10.0, .depth_m = 10.0},
                       .ramp_s = 0.0});
  }
  /// Runs for this many ticks of a millisecond each, or until there is a fault. Returns the
  /// fault.
  core::Fault run(int num_ticks) {
    for (int i = 0; i < num_ticks; ++i) {
      loop_.tick();
      telemetry_.fetch();
      if (core::is_failure(telemetry_.value().fault)) return telemetry_.value().fault;
      std::this_thread::sleep_for(kTick);
    }
    return core::Fault::kNone;
  }
  /// Runs for this many ticks, whatever the faults are.
  void go_on(int num_ticks) {
    for (int i = 0; i < num_ticks; ++i) {
      if (run(1) != core::Fault::kNone) std::this_thread::sleep_for(kTick);
    }
  }
  std::string words() const { return device_.words_of_fault(); }
  const core::Telemetry& told() const { return telemetry_.value(); }
  HapticLoop& loop() { return loop_; }
  core::EmergencyStop& stop() { return stop_; }

 private:
  HapticDevice& device_;
  core::LatestValue<core::HapticCommand> commands_;
  core::LatestValue<core::Telemetry> telemetry_;
  core::EmergencyStop stop_;
  HapticLoop loop_;
};

}  // namespace jnd::device
