#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "app/window/window_fixture.h"
#include "support/places.h"

namespace jnd::app {

inline constexpr const char* kStalled = "program stopped answering";

/// Takes pictures of every view, large and small, light and dark, for people who check them and
/// for the documents. It does not test what is stored.
class PicturesWindowTest : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    if (IsSkipped()) return;
    display_ = std::make_unique<VirtualDisplay>(1600, 1000);
    window_ = std::make_unique<WindowDriver>(*display_, path("home"));
    window_->forgives_stalls = true;
    // No path of this machine may appear in a picture.
    window_->share = path("jnd");
    std::filesystem::create_directory(window_->share);
    for (const char* part : {"protocols", "data"}) {
      std::filesystem::copy(test_support::source_folder() / part, window_->share / part,
                            std::filesystem::copy_options::recursive);
    }
  }

  /// Makes NAME-1600x1000-light.png and so on.
  void take(const std::string& name) { take(name, 2); }
  void take(const std::string& name, int num_shades) {
    if (!taken_.insert(name).second) return;
    for (const bool small : {false, true}) {
      window_->resize(small ? 1280 : 1600, small ? 720 : 1000);
      for (int shade = 0; shade < num_shades; ++shade) {
        const bool dark = window_->is_dark();
        const std::filesystem::path file =
            std::filesystem::path(JND_PICTURES) /
            (name + (small ? "-1280x720" : "-1600x1000") + (dark ? "-dark.png" : "-light.png"));
        window_->picture(file);
        EXPECT_GT(std::filesystem::file_size(file), 5000u) << file << " shows next to nothing";
        if (num_shades == 1) continue;
        window_->press("ctrl+d");
        window_->wait_until("the other shade",
                            [&](const Screen&) { return window_->is_dark() != dark; });
      }
    }
    window_->resize(1600, 1000);
    // If the session had stopped meanwhile, the picture is taken again when this card comes
    // again.
    if (window_->screen().shows(kStalled)) taken_.erase(name);
  }
  void close() {
    window_->press_close_button();
    EXPECT_EQ(window_->wait_for_exit().exit_code, 0);
  }

  /// Returns the words of the screen without numbers, which change all the time.
  static std::vector<std::string> words_of(const Screen& screen) {
    std::vector<std::string> words;
    for (const std::string& text : screen.texts) {
      if (text.find_first_of("0123456789") == std::string::npos) words.push_back(text);
    }
    return words;
  }

  static nlohmann::json shipped(const std::string& name) {
    return nlohmann::json::parse(
        read_file(test_support::source_folder() / "protocols" / (name + ".json")));
  }

  std::set<std::string> taken_;
};

}  // namespace jnd::app
