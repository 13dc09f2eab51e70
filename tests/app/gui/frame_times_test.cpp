#include "app/gui/frame_times.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "core/error.h"
#include "support/temporary_folder.h"

namespace jnd::app::gui {
namespace frame_times_test {

void draw_one(FrameTimes& times, const char* view) {
  times.begin_frame();
  times.end(FrameTimes::Part::kDraw);
  times.end(FrameTimes::Part::kRender);
  times.end(FrameTimes::Part::kShow);
  times.end_frame(view);
}

TEST(FrameTimes, AppendsALineForEachFrameThatCanBeReadAtOnce) {
  const test_support::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "times.txt";
  {
    FrameTimes times(file);
    draw_one(times, "start");
  }
  FrameTimes times(file);
  ASSERT_TRUE(times.wanted());
  draw_one(times, "session");

  std::ifstream lines(file);
  std::string line, view;
  for (const std::string expected : {"start", "session"}) {
    ASSERT_TRUE(std::getline(lines, line)) << expected;
    std::istringstream words(line);
    words >> view;
    EXPECT_EQ(view, expected);
    int count = 0;
    for (double ms = 0; words >> ms; ++count) EXPECT_GE(ms, 0.0) << line;
    EXPECT_EQ(count, 4) << line;
  }
  EXPECT_FALSE(std::getline(lines, line));
}

TEST(FrameTimes, NobodyMeasuresWithoutAFile) {
  FrameTimes times("");
  EXPECT_FALSE(times.wanted());
  draw_one(times, "start");
}

TEST(FrameTimes, AFileThatCannotBeWrittenIsRefusedInASentence) {
  const test_support::TemporaryFolder folder;
  const std::string file = (folder.path() / "missing" / "times.txt").string();
  try {
    FrameTimes times(file);
    FAIL() << "no error";
  } catch (const core::Error& error) {
    const std::string what = error.what();
    EXPECT_TRUE(what.starts_with(file + ": expected ")) << what;
    EXPECT_NE(what.find("JND_FRAME_TIMES"), std::string::npos) << what;
  }
}

}  // namespace frame_times_test
}  // namespace jnd::app::gui
