#include <gtest/gtest.h>

#include <set>
#include <string>

#include "app/gui/views/every_view.h"
#include "app/gui/views/layout_problems.h"

// From the smallest window to the largest, with the smallest and the largest letters, and in
// both themes, nothing of any view is cut or overlaps.

namespace jnd::app::gui {
namespace view_sizes_test {

struct Size {
  const char* name;
  float width_px, height_px;
  float monitor_scale;
  float zoom;  ///< The zoom that the person chose, from 0.5 to 2.
  bool is_dark = false;

  [[nodiscard]] float scale() const {
    return scale_with_room(monitor_scale * zoom, width_px, height_px);
  }
};

// The test view_languages_test.cpp uses the least size, too.
constexpr Size kSizes[] = {{"Least", 1024, 640, 1, 1},
                           {"LeastOfSmallLetters", 1024, 640, 1, 0.5f},
                           {"LeastOfLargeLetters", 1024, 640, 1, 2},
                           {"SmallOfSmallLetters", 1280, 800, 1, 0.5f, true},
                           {"SmallOfLargeLetters", 1280, 800, 1, 2},
                           {"UsualOfSmallLetters", 1920, 1080, 1, 0.5f},
                           {"Usual", 1920, 1080, 1, 1, true},
                           {"UsualOfLargeLetters", 1920, 1080, 1, 2},
                           {"LargeOfSmallLetters", 3840, 2160, 1, 0.5f},
                           {"LargeOfLargeLetters", 3840, 2160, 1, 2},
                           {"FineOfSmallLetters", 3840, 2160, 2, 0.5f},
                           {"FineOfLargeLetters", 3840, 2160, 2, 2, true}};

class ViewSizesTest : public EverySessionTest, public ::testing::WithParamInterface<Size> {
 protected:
  void look(const std::string& name, const Drawn& drawn) {
    ++num_seen_;
    const LayoutProblems problems(drawn, ui_.ui().screen());
    for (const std::string& problem : problems.sentences()) {
      if (told_.insert(problem).second) found_ += name + ": " + problem + "\n";
    }
  }

  const float scale_ = GetParam().scale();
  HeadlessUi ui_{GetParam().width_px / scale_, GetParam().height_px / scale_, scale_,
                 GetParam().is_dark};
  EveryView every_{ui_,
                   [this](const std::string& name, const Drawn& drawn) { look(name, drawn); }};
  std::set<std::string> told_;
  std::string found_;
  int num_seen_ = 0;
};

TEST_P(ViewSizesTest, HasRoomForEverything) {
  every_.start();
  every_.study();
  every_.overview();
  every_.record();
  every_.controls();
  every_.sessions();
  every_.results();
  every_.data();
  every_.device();
  every_.preparation();
  every_.session_dialogs();
  for_each_state(
      [this](const std::string& name, const SessionView& view) { every_.session(name, view); });
  EXPECT_GT(num_seen_, 160);
  EXPECT_EQ(told_.size(), 0U) << found_;
}

INSTANTIATE_TEST_SUITE_P(Windows, ViewSizesTest, ::testing::ValuesIn(kSizes),
                         [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace view_sizes_test
}  // namespace jnd::app::gui
