#include "core/controls/control_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "core/controls/piped_device.h"
#include "core/error.h"
#include "support/comes_about.h"
#include "support/pseudo_terminal.h"
#include "support/temporary_folder.h"

namespace jnd::core {
namespace control_reader_test {

namespace fs = std::filesystem;
using test_support::comes_about;
using Listens = ControlReader::Listens;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A folder of input devices, each of which is a pipe.
class ControlReaderTest : public ::testing::Test {
 protected:
  ~ControlReaderTest() override { reader_.reset(); }

  void begin(std::vector<ControlReader::SerialBoxPort> boxes = {}) {
    reader_ = std::make_unique<ControlReader>(ControlReader::Parameters{
        .folder = folder(),
        .serial_boxes = std::move(boxes),
        .open = [this](const fs::path& path) -> std::unique_ptr<ControlSource> {
          const std::lock_guard guard(mutex_);
          const auto device = devices_.find(path.filename().string());
          if (device == devices_.end()) throw Error(path.string() + ": not allowed");
          return device->second == nullptr ? nullptr : device->second->open();
        },
        .on_event =
            [this](const ControlEvent& event) {
              const std::lock_guard guard(mutex_);
              events_.push_back(event);
              read_ns_.push_back(test_clock_ns());
            },
        .on_lost =
            [this](const std::string& device) {
              const std::lock_guard guard(mutex_);
              lost_.push_back(device);
            },
        .on_change = [this] { ++num_changes_; }});
  }
  [[nodiscard]] fs::path folder() const { return temporary_.path(); }
  /// Adds a device that shows up as this file.
  PipedDevice& plug_in(const std::string& file, const std::string& name) {
    auto device = std::make_unique<PipedDevice>(name);
    PipedDevice& plugged = *device;
    {
      const std::lock_guard guard(mutex_);
      devices_[file] = std::move(device);
    }
    std::ofstream(folder() / file) << "";
    return plugged;
  }
  void listen(Listens listens, const ControlMap& map = {}) {
    reader_->listen(listens, map);
    ASSERT_TRUE(comes_about([&] { return reader_->is_settled(); }));
  }
  [[nodiscard]] std::vector<std::string> events() {
    const std::lock_guard guard(mutex_);
    std::vector<std::string> told;
    for (const ControlEvent& event : events_) {
      told.push_back((event.is_down ? "+" : "-") + stored_words(event.control));
    }
    return told;
  }
  [[nodiscard]] std::vector<std::string> lost() {
    const std::lock_guard guard(mutex_);
    return lost_;
  }
  [[nodiscard]] static ControlMap map_of(const std::string& device,
                                         const std::string& control = "KEY_B") {
    ControlMap map;
    map.set("first", {device, control});
    return map;
  }

  test_support::TemporaryFolder temporary_;
  std::mutex mutex_;
  std::map<std::string, std::unique_ptr<PipedDevice>> devices_;
  std::vector<ControlEvent> events_;
  std::vector<std::int64_t> read_ns_;
  std::vector<std::string> lost_;
  std::atomic<int> num_changes_{0};
  std::unique_ptr<ControlReader> reader_;
};

TEST_F(ControlReaderTest, ListensToWhatIsMappedAloneAndTakesItForItself) {
  PipedDevice& pedal = plug_in("event0", "pedal");
  PipedDevice& keyboard = plug_in("event1", "keyboard");
  begin();
  listen(Listens::kToNobody, map_of("pedal"));
  EXPECT_EQ(pedal.num_open, 0);
  listen(Listens::kToMapped, map_of("pedal"));
  EXPECT_TRUE(pedal.is_ours);
  EXPECT_EQ(keyboard.num_open, 0) << "nobody reads what is typed on it";
  pedal.key(KEY_B, true);
  pedal.key(KEY_B, false);
  ASSERT_TRUE(comes_about([&] { return events().size() == 2; }));
  EXPECT_THAT(events(), ElementsAre("+pedal/KEY_B", "-pedal/KEY_B"));
  listen(Listens::kToNobody, map_of("pedal"));
  EXPECT_EQ(pedal.num_open, 0);
  EXPECT_FALSE(pedal.is_ours);
  EXPECT_THAT(lost(), IsEmpty()) << "it was given back, not lost";
}

TEST_F(ControlReaderTest, WhoMapsHearsAllAndTakesNothingThatIsNotMapped) {
  PipedDevice& pedal = plug_in("event0", "pedal");
  plug_in("event1", "keyboard").is_keyboard = true;
  devices_["event2"] = nullptr;  // This is a mouse.
  std::ofstream(folder() / "event2") << "";
  std::ofstream(folder() / "event3") << "";  // This belongs to somebody else.
  std::ofstream(folder() / "mouse0") << "";
  begin();
  listen(Listens::kToAll);
  EXPECT_FALSE(pedal.is_ours);
  const auto devices = reader_->devices();
  ASSERT_EQ(devices.size(), 3U);
  EXPECT_EQ(devices[0].device, "pedal");
  EXPECT_FALSE(devices[0].is_mapped || devices[0].is_keyboard);
  EXPECT_TRUE(devices[1].is_keyboard);
  EXPECT_NE(devices[2].problem.find("not allowed"), std::string::npos);
  // A key is pressed to be mapped. Other programs saw it go down, so they have to see it come
  // up, too.
  pedal.key(KEY_B, true);
  ASSERT_TRUE(comes_about([&] { return events().size() == 1; }));
  listen(Listens::kToAll, map_of("pedal"));
  EXPECT_FALSE(pedal.is_ours);
  pedal.key(KEY_B, false);
  EXPECT_TRUE(comes_about([&] { return pedal.is_ours.load(); }));
  EXPECT_TRUE(comes_about([&] {
    const auto now = reader_->devices();
    return now.size() == 3 && now[0].is_mapped && now[0].is_ours;
  }));
  EXPECT_GT(num_changes_, 0);
}

TEST_F(ControlReaderTest, ADeviceThatIsPluggedInLaterIsThere) {
  begin();
  listen(Listens::kToMapped, map_of("pedal"));
  EXPECT_THAT(reader_->devices(), IsEmpty());
  PipedDevice& pedal = plug_in("event7", "pedal");
  ASSERT_TRUE(comes_about([&] { return pedal.is_ours.load(); }));
  pedal.key(KEY_B, true);
  ASSERT_TRUE(comes_about([&] { return events().size() == 1; }));
}

// udev grants the rights a moment after the kernel has made the file.
TEST_F(ControlReaderTest, ADeviceWhoseRightsComeLaterIsOpenedThen) {
  std::ofstream(folder() / "event0") << "";
  begin();
  listen(Listens::kToMapped, map_of("pedal"));
  ASSERT_EQ(reader_->devices().size(), 1U);
  {
    const std::lock_guard guard(mutex_);
    devices_["event0"] = std::make_unique<PipedDevice>("pedal");
  }
  fs::permissions(folder() / "event0", fs::perms::owner_read);
  EXPECT_TRUE(comes_about([&] { return devices_["event0"]->is_ours.load(); }));
}

TEST_F(ControlReaderTest, AMappedDeviceThatIsPulledIsToldOnceAndComesBack) {
  PipedDevice& pedal = plug_in("event0", "pedal");
  PipedDevice& other = plug_in("event1", "other");
  begin();
  listen(Listens::kToAll, map_of("pedal"));
  other.unplug();
  pedal.unplug();
  ASSERT_TRUE(comes_about([&] { return !lost().empty(); }));
  fs::remove(folder() / "event0");
  fs::remove(folder() / "event1");
  ASSERT_TRUE(comes_about([&] { return reader_->devices().empty(); }));
  EXPECT_THAT(lost(), ElementsAre("pedal"));
  PipedDevice& again = plug_in("event5", "pedal");
  EXPECT_TRUE(comes_about([&] { return again.is_ours.load(); }));
}

// The time of a press is the kernel's, whenever the press was read.
TEST_F(ControlReaderTest, APressKeepsItsOwnTimeHoweverLateItIsRead) {
  PipedDevice& pedal = plug_in("event0", "pedal");
  begin();
  listen(Listens::kToMapped, map_of("pedal"));
  constexpr std::size_t kNumPresses = 200;
  std::vector<std::int64_t> pressed_ns;
  for (std::size_t i = 0; i < kNumPresses; ++i) {
    pressed_ns.push_back(test_clock_ns() / 1'000 * 1'000);  // The kernel counts microseconds.
    pedal.key(KEY_B, true, pressed_ns.back());
    pedal.key(KEY_B, false);
    std::this_thread::sleep_for(std::chrono::microseconds(500));
  }
  ASSERT_TRUE(comes_about([&] { return events().size() == 2 * kNumPresses; }));
  std::size_t press = 0;
  std::vector<double> read_after_ms;
  for (std::size_t i = 0; i < events_.size(); ++i) {
    if (!events_[i].is_down) continue;
    EXPECT_EQ(events_[i].monotonic_ns, pressed_ns.at(press));
    read_after_ms.push_back(1e-6 * static_cast<double>(read_ns_[i] - pressed_ns.at(press)));
    ++press;
  }
  EXPECT_EQ(press, kNumPresses);
  std::ranges::sort(read_after_ms);
  RecordProperty("read_after_ms_p50", std::to_string(read_after_ms[kNumPresses / 2]));
  RecordProperty("read_after_ms_p99", std::to_string(read_after_ms[kNumPresses * 99 / 100]));
}

TEST_F(ControlReaderTest, ASerialBoxAnswersByBytes) {
  const test_support::PseudoTerminal box;
  begin({{.path = box.path(), .baud = 115200}});
  const std::string name = "serial " + box.path();
  listen(Listens::kToMapped, map_of("pedal"));
  EXPECT_THAT(reader_->devices(), IsEmpty()) << "nothing on it is mapped";
  listen(Listens::kToMapped, map_of(name, "byte 49"));
  ASSERT_EQ(reader_->devices().size(), 1U);
  EXPECT_TRUE(reader_->devices()[0].is_ours);
  const std::int64_t before_ns = test_clock_ns();
  box.send({49, 13, 0});
  ASSERT_TRUE(comes_about([&] { return events().size() == 6; }));
  EXPECT_THAT(events(), ElementsAre("+" + name + "/byte 49", "-" + name + "/byte 49",
                                    "+" + name + "/byte 13", "-" + name + "/byte 13",
                                    "+" + name + "/byte 0", "-" + name + "/byte 0"));
  EXPECT_GE(events_[0].monotonic_ns, before_ns);
  EXPECT_LE(events_[0].monotonic_ns, test_clock_ns());
}

TEST_F(ControlReaderTest, ASerialBoxThatIsNotThereSaysSo) {
  begin({{.path = "/dev/ttyUSB_none"}});
  listen(Listens::kToAll);
  ASSERT_EQ(reader_->devices().size(), 1U);
  EXPECT_NE(reader_->devices()[0].problem.find("look whether it is plugged in"),
            std::string::npos);
}

TEST(InputDevices, AreListedByTheirNumbersAndOnlyWhereThereAreAny) {
  const test_support::TemporaryFolder folder;
  for (const char* file : {"event10", "event2", "mouse0", "eventX", "event3b"}) {
    std::ofstream(folder.path() / file) << "";
  }
  const auto devices = input_devices(folder.path());
  ASSERT_EQ(devices.size(), 2U);
  EXPECT_EQ(devices[0].path.filename(), "event2");
  EXPECT_EQ(devices[1].path.filename(), "event10");
  EXPECT_TRUE(devices[0].can_read);
  EXPECT_TRUE(input_devices(folder.path() / "none").empty());
  EXPECT_THROW((void)open_input_device(folder.path() / "event2"), Error) << "a plain file";
}

}  // namespace control_reader_test
}  // namespace jnd::core
