#include "device/network/device_key.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>
#include <string>

#include "core/error.h"
#include "support/files.h"
#include "support/temporary_folder.h"

namespace jnd::device {
namespace device_key_test {

namespace fs = std::filesystem;

std::string why_not(const fs::path& file) {
  try {
    (void)read_device_key(file);
  } catch (const core::Error& error) {
    return error.what();
  }
  return "read";
}

class DeviceKeyTest : public ::testing::Test {
 protected:
  test_support::TemporaryFolder temporary;
  fs::path file = temporary.path() / "keys" / "robot.key";
};

TEST_F(DeviceKeyTest, IsDrawnOnceAndReadBack) {
  make_device_key(file);
  const DeviceKey key = read_device_key(file);
  EXPECT_EQ(read_device_key(file), key);
  const fs::path other = temporary.path() / "other.key";
  make_device_key(other);
  EXPECT_NE(read_device_key(other), key);
  EXPECT_EQ(test_support::read_file(file).size(), 65u)
      << "64 digits and a line's end, for other programs to read";
  EXPECT_THROW(make_device_key(file), core::Error) << "never overwritten";
  EXPECT_EQ(read_device_key(file), key);
}

TEST_F(DeviceKeyTest, NobodyElseMayRead) {
  make_device_key(file);
  struct stat status {};
  ASSERT_EQ(::stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600u);
  for (const mode_t others : {0640u, 0604u, 0620u}) {
    ASSERT_EQ(::chmod(file.c_str(), others), 0);
    EXPECT_NE(why_not(file).find("chmod 600"), std::string::npos) << why_not(file);
  }
}

TEST_F(DeviceKeyTest, WhatIsNoneIsToldSo) {
  EXPECT_NE(why_not(file).find("jnd device-key robot"), std::string::npos) << why_not(file);
  fs::create_directories(file.parent_path());
  for (const std::string& text :
       {std::string(), std::string("12"), std::string(64, 'g'), std::string(63, 'a'),
        std::string(65, 'a'), std::string(64, 'A'), std::string(64, 'a') + "\n\n"}) {
    fs::remove(file);
    std::ofstream(file) << text;
    ASSERT_EQ(::chmod(file.c_str(), 0600), 0);
    EXPECT_NE(why_not(file).find("64 hexadecimal digits"), std::string::npos) << why_not(file);
  }
}

TEST_F(DeviceKeyTest, ANameIsNoPath) {
  ASSERT_EQ(::setenv("XDG_CONFIG_HOME", temporary.path().c_str(), 1), 0);
  EXPECT_EQ(device_key_file("robot-2_b"),
            temporary.path() / "jnd" / "device-keys" / "robot-2_b.key");
  for (const char* name : {"", "../robot", "a/b", "a.b", "a b", "\xc3\xa4"}) {
    EXPECT_THROW((void)device_key_file(name), core::Error) << name;
  }
  ASSERT_EQ(::unsetenv("XDG_CONFIG_HOME"), 0);
}

}  // namespace device_key_test
}  // namespace jnd::device
