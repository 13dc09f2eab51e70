#include "app/session/found_ports.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "support/temporary_folder.h"

namespace jnd::app {
namespace found_ports_test {

namespace fs = std::filesystem;

TEST(FoundPorts, AreInputDevicesPortsWithHardwareAndParallelPorts) {
  const test_support::TemporaryFolder root;
  const auto write = [&](const std::string& file, const std::string& text) {
    fs::create_directories((root.path() / file).parent_path());
    std::ofstream(root.path() / file) << text;
  };
  for (const char* file : {"input/event1", "input/mouse0", "ttyUSB0", "ttyACM3", "ttyS0",
                           "ttyS1", "ttyS2", "tty1", "parport0", "null"}) {
    write(std::string("dev/") + file, "");
  }
  write("sys/class/tty/ttyS0/type", "0\n");
  write("sys/class/tty/ttyS1/type", "4\n");
  std::vector<std::string> found;
  for (const FoundPort& port : found_ports(root.path())) {
    EXPECT_TRUE(port.may_use) << port.path;
    found.push_back(std::string(kind_words(port.kind)) + " " + port.path.filename().string() +
                    " " + group_of(port.kind));
  }
  EXPECT_EQ(found, (std::vector<std::string>{"input event1 input", "parallel parport0 lp",
                                             "serial ttyACM3 dialout", "serial ttyS1 dialout",
                                             "serial ttyUSB0 dialout"}));
  EXPECT_TRUE(found_ports(root.path() / "none").empty());
}

}  // namespace found_ports_test
}  // namespace jnd::app
