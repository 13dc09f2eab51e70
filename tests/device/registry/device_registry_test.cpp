#include "device/registry/device_registry.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "core/error.h"

namespace jnd::device {
namespace device_registry_test {

TEST(DeviceRegistry, EveryDeviceIsMadeUnderItsOwnName) {
  std::set<std::string> names;
  for (const DeviceEntry& entry : devices()) {
    const auto device = entry.make("", 1000.0);
    ASSERT_NE(device, nullptr);
    EXPECT_EQ(device->name(), entry.name);
    const std::string argument = entry.argument.empty() ? "" : ":127.0.0.1:4700";
    EXPECT_EQ(&device_named(std::string(entry.name) + argument), &entry);
    EXPECT_FALSE(entry.description.empty());
    names.emplace(entry.name);
  }
  EXPECT_EQ(names.size(), devices().size());
  EXPECT_TRUE(names.contains("lumped"));
}

TEST(DeviceRegistry, OneOfThemNeverStarts) {
  const auto device = make_device("unplugged", 1000.0);
  EXPECT_THROW(device->open(), core::Error);
  core::HapticState state;
  EXPECT_FALSE(device->read(state));
  EXPECT_FALSE(device->write(core::zero_vectors()));
}

TEST(DeviceRegistry, AnUnknownNameIsToldTheKnownOnes) {
  try {
    static_cast<void>(device_named("phantom"));
    FAIL() << "a device that does not exist was found";
  } catch (const core::Error& error) {
    EXPECT_STREQ(error.what(),
                 "device: expected one of lumped, exoskeleton, mouse, network:HOST:PORT, "
                 "plugin:PATH, twin, unplugged, found phantom");
  }
}

TEST(DeviceRegistry, HasOneNameForAllSpellingsOfADevice) {
  EXPECT_EQ(canonical_name("lumped"), "lumped");
  EXPECT_EQ(canonical_name("network:localhost:4700,simulated"), "network:127.0.0.1:4700");
  EXPECT_EQ(canonical_name("network:10.0.0.2:4700,key=a"), "network:10.0.0.2:4700");
  EXPECT_EQ(canonical_name("plugin:/no/such/../robot.so:port=1,real"),
            "plugin:/no/robot.so:port=1");
}

TEST(DeviceRegistry, ADeviceOnAnotherMachineNeedsAKey) {
  for (const char* place : {"network:192.0.2.1:4700", "network:192.0.2.1:4700,simulated",
                            "network:[2001:db8::1]:4700"}) {
    try {
      static_cast<void>(make_device(place, 1000.0));
      ADD_FAILURE() << place;
    } catch (const DeviceUnreachable& error) {
      // If there is no way to IPv6 at all, the message says that first.
      EXPECT_NE(std::string(place).find('['), std::string::npos) << error.what();
    } catch (const core::Error& error) {
      EXPECT_NE(std::string(error.what()).find("expected a key"), std::string::npos)
          << error.what();
    }
  }
}

TEST(DeviceRegistry, AnArgumentThatIsMissingOrTooMuchIsNamed) {
  EXPECT_THROW(static_cast<void>(device_named("network")), core::Error);
  EXPECT_THROW(static_cast<void>(device_named("lumped:1")), core::Error);
  EXPECT_THROW(static_cast<void>(make_device("network:nowhere", 1000.0)), core::Error);
}

}  // namespace device_registry_test
}  // namespace jnd::device
