#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/controls/control_source.h"

#ifdef JND_HAS_UMOCKDEV
#include <linux/input.h>
#include <sys/ioctl.h>
#include <umockdev.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "support/comes_about.h"
#include "support/temporary_folder.h"
#endif

namespace jnd::core {
namespace evdev_device_test {

#ifndef JND_HAS_UMOCKDEV

TEST(EvdevDevice, IsTriedWithADeviceOfUmockdev) {
  GTEST_SKIP() << "expected umockdev (libumockdev-dev) when the tests were built, found none";
}

#else

using test_support::comes_about;

constexpr char kPreloaded[] = "JND_UMOCKDEV_IS_PRELOADED";

/// Returns whether umockdev is preloaded. It must be there when a program starts, so the test
/// runs in another process, which umockdev-wrapper starts.
bool is_preloaded() { return std::getenv(kPreloaded) != nullptr; }

int run_preloaded(const char* name) {
  char path[4096];
  const ssize_t length = ::readlink("/proc/self/exe", path, sizeof path - 1);
  if (length <= 0) return -1;
  path[length] = '\0';
  const std::string command = std::string("umockdev-wrapper '") + path +
                              "' --gtest_brief=1 --gtest_filter=EvdevDevice." + name;
  return std::system(("env -u GTEST_TOTAL_SHARDS -u GTEST_SHARD_INDEX " +
                      std::string(kPreloaded) + "=1 timeout 30 " + command)
                         .c_str());
}

/// The kernel's side of a pedal: what it is asked and what it reports.
class MockedPedal {
 public:
  MockedPedal(std::vector<unsigned> keys, bool is_mouse)
      : keys_(std::move(keys)), is_mouse_(is_mouse), bed_(umockdev_testbed_new()) {
    GError* error = nullptr;
    umockdev_testbed_add_from_string(
        bed_,
        "P: /devices/virtual/input/input20/event20\nN: input/event20\n"
        "E: DEVNAME=/dev/input/event20\nE: SUBSYSTEM=input\nA: dev=13:84\n",
        &error);
    handler_ = umockdev_ioctl_base_new();
    g_signal_connect(handler_, "handle-ioctl", G_CALLBACK(answer), this);
    umockdev_testbed_attach_ioctl(bed_, "/dev/input/event20", handler_, &error);
    EXPECT_EQ(error, nullptr) << (error != nullptr ? error->message : "");
  }
  ~MockedPedal() {
    umockdev_testbed_detach_ioctl(bed_, "/dev/input/event20", nullptr);
    g_object_unref(handler_);
    g_object_unref(bed_);
  }
  MockedPedal(const MockedPedal&) = delete;
  MockedPedal& operator=(const MockedPedal&) = delete;

  void press(const std::string& events) {
    const auto file = folder_.path() / "pedal.events";
    std::ofstream(file) << events;
    GError* error = nullptr;
    umockdev_testbed_load_evemu_events(bed_, "/dev/input/event20", file.c_str(), &error);
    EXPECT_EQ(error, nullptr) << (error != nullptr ? error->message : "");
  }

  std::atomic<int> clock{-1}, grab{-1};

 private:
  static gboolean answer(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer me) {
    static_cast<MockedPedal*>(me)->answer_one(client);
    return 1;
  }

  void answer_one(UMockdevIoctlClient* client) {
    const auto request = static_cast<unsigned>(umockdev_ioctl_client_get_request(client));
    UMockdevIoctlData* arg = umockdev_ioctl_client_get_arg(client);
    if (_IOC_TYPE(request) != 'E') return umockdev_ioctl_client_complete(client, -1, ENOTTY);
    if (request == EVIOCGRAB) {
      // The argument is the number itself, and not its address.
      guint8* bytes = nullptr;
      gint count = 0;
      umockdev_ioctl_data_retrieve(arg, &bytes, &count);
      grab = count > 0 && bytes[0] != 0 ? 1 : 0;
      g_free(bytes);
      return umockdev_ioctl_client_complete(client, 0, 0);
    }
    const unsigned size = _IOC_SIZE(request);
    UMockdevIoctlData* data = umockdev_ioctl_data_resolve(arg, 0, size, nullptr);
    if (data == nullptr) return umockdev_ioctl_client_complete(client, -1, EFAULT);
    if (request == EVIOCSCLOCKID) {
      guint8* bytes = nullptr;
      gint count = 0;
      umockdev_ioctl_data_retrieve(data, &bytes, &count);
      int asked = -1;
      if (count >= static_cast<gint>(sizeof asked)) std::memcpy(&asked, bytes, sizeof asked);
      clock = asked;
      g_free(bytes);
    } else if ((_IOC_DIR(request) & _IOC_READ) != 0) {
      std::vector<guint8> told = told_for(_IOC_NR(request), size);
      umockdev_ioctl_data_update(data, 0, told.data(), static_cast<gint>(told.size()));
    }
    umockdev_ioctl_client_complete(client, static_cast<glong>(size), 0);
    umockdev_ioctl_data_unref(data);
  }

  [[nodiscard]] std::vector<guint8> told_for(unsigned number, unsigned size) const {
    std::vector<guint8> bytes(size, 0);
    const auto set_bit = [&](unsigned bit) {
      if (bit / 8 < bytes.size()) bytes[bit / 8] |= static_cast<guint8>(1U << bit % 8);
    };
    const auto copy = [&](const void* from, std::size_t length) {
      std::memcpy(bytes.data(), from, std::min<std::size_t>(length, bytes.size()));
    };
    constexpr unsigned kBits = 0x20;
    if (number == _IOC_NR(EVIOCGVERSION)) {
      const int version = EV_VERSION;
      copy(&version, sizeof version);
    } else if (number == _IOC_NR(EVIOCGID)) {
      const input_id id{.bustype = BUS_USB, .vendor = 0x0c45, .product = 0x7403, .version = 1};
      copy(&id, sizeof id);
    } else if (number == _IOC_NR(EVIOCGNAME(0))) {
      constexpr char kName[] = "PCsensor FootSwitch";
      copy(kName, sizeof kName);
    } else if (number == kBits) {
      set_bit(EV_SYN);
      set_bit(EV_KEY);
      if (is_mouse_) set_bit(EV_REL);
    } else if (number == kBits + EV_KEY) {
      for (const unsigned key : keys_) set_bit(key);
    } else if (number == kBits + EV_REL && is_mouse_) {
      set_bit(REL_X);
    }
    return bytes;
  }

  std::vector<unsigned> keys_;
  bool is_mouse_;
  test_support::TemporaryFolder folder_;
  UMockdevTestbed* bed_;
  UMockdevIoctlBase* handler_ = nullptr;
};

TEST(EvdevDevice, IsOpenedByItsNameWithTheMonotonicClockAndTakenOnlyWhenAsked) {
  if (!is_preloaded()) {
    const int outcome =
        run_preloaded("IsOpenedByItsNameWithTheMonotonicClockAndTakenOnlyWhenAsked");
    EXPECT_EQ(outcome, 0) << "in the program with umockdev preloaded";
    return;
  }
  MockedPedal pedal({KEY_A, KEY_B, KEY_C}, /*is_mouse=*/false);
  const auto source = open_input_device("/dev/input/event20");
  ASSERT_NE(source, nullptr);
  EXPECT_EQ(source->device(), "0c45:7403 PCsensor FootSwitch");
  EXPECT_FALSE(source->is_keyboard());
  EXPECT_EQ(pedal.clock, CLOCK_MONOTONIC);
  EXPECT_EQ(pedal.grab, -1) << "whoever only listens takes nothing";
  // The pedal is held down for a second.
  pedal.press(
      "E: 0.000000 0001 0030 1\nE: 0.000000 0000 0000 0\n"
      "E: 1.000000 0001 0030 0\nE: 1.000000 0000 0000 0\n");
  std::vector<ControlEvent> events;
  const auto come = [&](std::size_t count) {
    return comes_about([&] {
      for (ControlEvent& event : source->take()) events.push_back(std::move(event));
      return events.size() == count;
    });
  };
  ASSERT_TRUE(come(1));
  EXPECT_EQ(events[0].control.name, "KEY_B");
  EXPECT_FALSE(source->take_for_ourselves(true)) << "it is held";
  EXPECT_EQ(pedal.grab, -1);
  ASSERT_TRUE(come(2));
  EXPECT_TRUE(source->take_for_ourselves(true));
  EXPECT_NE(pedal.grab, -1);
}

TEST(EvdevDevice, AMouseIsNoneAndAWholeKeyboardIsKnown) {
  if (!is_preloaded()) {
    EXPECT_EQ(run_preloaded("AMouseIsNoneAndAWholeKeyboardIsKnown"), 0);
    return;
  }
  {
    const MockedPedal mouse({BTN_LEFT, BTN_RIGHT}, /*is_mouse=*/true);
    EXPECT_EQ(open_input_device("/dev/input/event20"), nullptr);
  }
  const MockedPedal keyboard(
      {KEY_ESC, KEY_ENTER, KEY_SPACE, KEY_Q, KEY_M, KEY_LEFTSHIFT, KEY_B}, /*is_mouse=*/false);
  const auto source = open_input_device("/dev/input/event20");
  ASSERT_NE(source, nullptr);
  EXPECT_TRUE(source->is_keyboard());
}

#endif

}  // namespace evdev_device_test
}  // namespace jnd::core
