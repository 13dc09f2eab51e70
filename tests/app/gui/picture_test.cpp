#include "app/gui/picture.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "support/temporary_folder.h"

namespace jnd::app::gui {
namespace picture_test {

namespace fs = std::filesystem;

/// Every pixel another colour.
Picture pattern(int width, int height) {
  Picture picture = {.width = width, .height = height};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (const int value : {x, y, x ^ y, 255}) {
        picture.rgba.push_back(static_cast<std::uint8_t>(value));
      }
    }
  }
  return picture;
}

TEST(Picture, IsReadAsItWasWritten) {
  const test_support::TemporaryFolder temporary;
  const fs::path file = temporary.path() / "frame.png";
  const Picture picture = pattern(31, 17);
  write_png(file, picture);
  const Picture read = read_png(file);
  EXPECT_EQ(read.width, 31);
  EXPECT_EQ(read.height, 17);
  EXPECT_EQ(read.rgba, picture.rgba);
  EXPECT_FALSE(fs::exists(temporary.path() / "frame.png.tmp"));
}

TEST(Picture, ReplacesWhatWasThereOrLeavesItAlone) {
  const test_support::TemporaryFolder temporary;
  const fs::path file = temporary.path() / "frame.png";
  write_png(file, pattern(4, 4));
  write_png(file, pattern(8, 2));
  EXPECT_EQ(read_png(file).width, 8);
  EXPECT_THROW(write_png(file, {.width = 3, .height = 3}), core::Error);
  EXPECT_EQ(read_png(file).width, 8);
}

TEST(Picture, WhereItCannotBeWrittenTheErrorNamesTheFile) {
  const test_support::TemporaryFolder temporary;
  const fs::path file = temporary.path() / "missing" / "frame.png";
  try {
    write_png(file, pattern(4, 4));
    FAIL();
  } catch (const core::Error& error) {
    EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos);
  }
}

TEST(Picture, WhatIsNoPictureIsRefused) {
  const test_support::TemporaryFolder temporary;
  const fs::path file = temporary.path() / "text.png";
  std::ofstream(file) << "not a picture";
  EXPECT_THROW((void)read_png(file), core::Error);
  EXPECT_THROW((void)read_png(temporary.path() / "nothing.png"), core::Error);
}

TEST(Picture, APartIsCutOutAsFarAsItLiesInside) {
  const Picture picture = pattern(10, 8);
  const Picture part = cut_out(picture, 2, 3, 4, 2);
  ASSERT_EQ(part.width, 4);
  ASSERT_EQ(part.height, 2);
  EXPECT_EQ(part.rgba[0], 2);
  EXPECT_EQ(part.rgba[1], 3);
  const Picture beyond = cut_out(picture, 8, -2, 40, 5);
  EXPECT_EQ(beyond.width, 2);
  EXPECT_EQ(beyond.height, 3);
  EXPECT_EQ(beyond.rgba.size(), 2u * 3u * 4u);
  EXPECT_EQ(cut_out(picture, 20, 20, 5, 5).width, 0);
}

}  // namespace picture_test
}  // namespace jnd::app::gui
