#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <thread>

#include "core/error.h"
#include "device/plugin/plugin_device.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace jnd::device {

/// Builds a driver as somebody does who has nothing of this program but the header.
inline std::filesystem::path built_driver(const std::filesystem::path& source,
                                          const std::filesystem::path& folder,
                                          const std::string& name,
                                          const std::string& definition = "") {
  const std::filesystem::path made = folder / (name + ".so");
  const std::filesystem::path header = folder / "include" / "jnd_device.h";
  if (!std::filesystem::exists(header)) {
    std::filesystem::create_directories(header.parent_path());
    std::filesystem::copy_file(
        test_support::source_folder() / "device" / "plugin" / "jnd_device.h", header);
  }
  const std::string command = "cc -std=c11 -D_GNU_SOURCE -Wall -Wextra -Werror -shared -fPIC " +
                              (definition.empty() ? "" : "-D" + definition + " ") + "-I '" +
                              header.parent_path().string() + "' '" + source.string() +
                              "' -lm -o '" + made.string() + "'";
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  return made;
}

inline std::filesystem::path example_source() {
  return test_support::source_folder() / "device" / "plugin" / "example_device.c";
}

/// Makes drivers, each of which is built once for all tests.
class PluginTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { folder_ = std::make_unique<test_support::TemporaryFolder>(); }
  static void TearDownTestSuite() { folder_.reset(); }
  /// Names the program that runs drivers, so that no driver has to be told where it is. A
  /// driver that crashes has to do so at once: a sanitizer's report takes longer than the
  /// program waits for a driver.
  void SetUp() override {
    ::setenv("JND_DEVICE_HOST", test_support::device_host_file().c_str(), 1);
    const char* others = std::getenv("ASAN_OPTIONS");
    const std::string options = others == nullptr ? "" : std::string(others) + ":";
    if (options.find("handle_segv") == std::string::npos) {
      ::setenv("ASAN_OPTIONS", (options + "handle_segv=0:handle_abort=0").c_str(), 1);
    }
  }

  static std::filesystem::path built(const std::filesystem::path& source,
                                     const std::string& name,
                                     const std::string& definition = "") {
    const std::filesystem::path made = folder_->path() / (name + ".so");
    if (std::filesystem::exists(made)) return made;
    return built_driver(source, folder_->path(), name, definition);
  }
  static std::filesystem::path example() { return built(example_source(), "example"); }
  static std::filesystem::path hostile(const std::string& definition = "") {
    return built(
        test_support::source_folder() / "tests" / "device" / "plugin" / "hostile_driver.c",
        "hostile" + definition, definition);
  }
  /// An argument "plugin:" of a driver with this trouble.
  static std::string troubled(const std::string& trouble, const std::string& more = "") {
    return hostile().string() + ":simulated,trouble=" + trouble + more;
  }

  static std::unique_ptr<HapticDevice> opened(const std::string& argument,
                                              double rate_hz = 1000.0) {
    std::unique_ptr<HapticDevice> device = make_plugin_device(argument, rate_hz);
    device->open();
    return device;
  }
  /// What the program says of a driver that cannot be used; "" if it can.
  static std::string why_not(const std::string& argument) {
    try {
      (void)opened(argument);
    } catch (const DeviceUnreachable& error) {
      return error.what();
    }
    return "";
  }
  static core::PointVectors pushed(double force_n) {
    core::PointVectors all = core::zero_vectors();
    all[0].x() = force_n;
    return all;
  }
  static void pause_ms(int milliseconds) {
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
  }

  /// What the motors of the hostile driver were told.
  struct Motors {
    double force_n = 0.0;
    double num_halts = 0.0;
  };
  static std::filesystem::path motor_file() { return folder_->path() / "motors"; }
  static Motors motors() {
    Motors told;
    std::ifstream(motor_file(), std::ios::binary)
        .read(reinterpret_cast<char*>(&told), sizeof told);
    return told;
  }
  /// A driver at its own pace, with a log of its motors.
  static std::string own_clock(const std::string& trouble, const std::string& more = "") {
    std::filesystem::remove(motor_file());
    return hostile().string() + ":" + (more.empty() ? "real" : more) +
           ",flags=4,log=" + motor_file().string() + ",trouble=" + trouble;
  }
  /// Whether the condition holds within some seconds.
  template <typename Condition>
  static bool comes_to(const Condition& condition) {
    for (int i = 0; i < 5000; ++i) {
      if (condition()) return true;
      pause_ms(1);
    }
    return false;
  }

 private:
  static inline std::unique_ptr<test_support::TemporaryFolder> folder_;
};

}  // namespace jnd::device
