#include "device/plugin/plugin_options.h"

#include <cstdlib>
#include <fstream>

#include "plugin_fixture.h"

namespace jnd::device {
namespace plugin_options_test {

namespace fs = std::filesystem;

TEST(PluginOptions, AreThePathAndWhatIsForUsAndForTheDriver) {
  const PluginOptions options = plugin_options("./hand.so:simulated,port=3,in-process,a=b=c");
  EXPECT_EQ(options.name, "./hand.so");
  EXPECT_TRUE(options.says_simulated && options.in_process && !options.says_real);
  EXPECT_EQ(options.of_driver, "port=3,a=b=c");
  EXPECT_EQ(plugin_options("hand").of_driver, "");
  for (const char* wrong : {":real", "hand:fast", "hand:simulated,real", "hand:=3"}) {
    EXPECT_THROW((void)plugin_options(wrong), core::Error) << wrong;
  }
  EXPECT_THROW((void)plugin_options("hand:a=" + std::string(2000, 'x')), core::Error);
}

TEST(PluginOptions, ABareNameIsLookedForInTheFoldersOfTheVariable) {
  const test_support::TemporaryFolder folder;
  std::ofstream(folder.path() / "a_hand.so") << "x";
  ::setenv("JND_DEVICE_PATH", ("/nowhere:" + folder.path().string()).c_str(), 1);
  EXPECT_EQ(plugin_file("a_hand"), folder.path() / "a_hand.so");
  EXPECT_EQ(plugin_file("a_hand.so"), folder.path() / "a_hand.so");
  EXPECT_THROW((void)plugin_file("./a_hand"), DeviceUnreachable) << "a path is a path";
  try {
    (void)plugin_file("another");
    FAIL() << "found";
  } catch (const DeviceUnreachable& error) {
    EXPECT_NE(std::string(error.what()).find(folder.path().string()), std::string::npos);
  }
  ::unsetenv("JND_DEVICE_PATH");
}

TEST(PluginOptions, AHostThatIsNotThereIsNamed) {
  ::setenv("JND_DEVICE_HOST", "/nowhere/jnd-device-host", 1);
  EXPECT_THROW((void)device_host_file(), DeviceUnreachable);
  ::unsetenv("JND_DEVICE_HOST");
}

}  // namespace plugin_options_test
}  // namespace jnd::device
