#include "app/gui/views/apparatus_view.h"

#include <gtest/gtest.h>

#include <limits>
#include <regex>

#include "app/gui/headless_ui.h"

namespace jnd::app::gui {
namespace apparatus_view_test {

SessionView felt() {
  SessionView view{
      .study = "Viscosity discrimination", .participant = "P07", .device = "lumped"};
  view.step = Step::kPresenting;
  view.heading = "Test fluid";
  view.sentence = "Show one finger.";
  view.loop = {.rate_hz = 1000, .max_lateness_us = 12.0, .missed_ticks = 0};
  view.telemetry.sample.tick = 77;
  view.telemetry.sample.attached_bits = 31;
  return view;
}

/// Draws the view, and remembers what it was asked for.
class ApparatusView : public ::testing::Test {
 protected:
  RunViewResult draw(const SessionView& view) {
    RunViewResult all;
    ui_.frame([&](Ui& ui) {
      RunViewResult result = draw_apparatus_view(ui, view, sources_, run_, state_);
      all.stop = all.stop || result.stop;
      for (OperatorRequest& request : result.requests) all.requests.push_back(request);
    });
    return all;
  }
  [[nodiscard]] const Drawn& drawn() const { return ui_.drawn(); }

  /// Returns one second of data for each named channel. Its value is its number in the request,
  /// and it has a gap of two intervals.
  static ScopePicture picture_of(const std::vector<std::string>& names) {
    ScopePicture picture{.newest_s = 30.0};
    for (std::size_t i = 0; i < names.size(); ++i) {
      picture.channels.emplace_back();
      if (names[i].empty()) continue;
      for (int point = 0; point < 100; ++point) {
        if (point == 40 || point == 41) continue;
        const auto value = static_cast<float>(names[i].size());
        picture.channels[i].push_back({29.01 + 0.01 * point, value, value});
      }
    }
    return picture;
  }

  HeadlessUi ui_;
  RunViewState run_{.shows_apparatus = true};
  ApparatusViewState state_;
  std::vector<std::vector<std::string>> asked_scopes_;
  std::vector<SceneRequest> asked_scenes_;
  ApparatusSources sources_{.scopes =
                                [this](const std::vector<std::string>& names) {
                                  asked_scopes_.push_back(names);
                                  return picture_of(names);
                                },
                            .paint =
                                [this](const SceneRequest& request) {
                                  asked_scenes_.push_back(request);
                                  return std::uintptr_t{1};
                                }};
};

TEST_F(ApparatusView, ShowsThePictureOfTheNewestSampleAndTheScopesOfItsChannels) {
  SessionView view = felt();
  view.surroundings.has_walls = true;
  draw(view);
  EXPECT_TRUE(drawn().shows("picture of the apparatus"));
  ASSERT_FALSE(asked_scenes_.empty());
  EXPECT_EQ(asked_scenes_.back().sample.tick, 77);
  EXPECT_TRUE(asked_scenes_.back().surroundings.has_walls);
  EXPECT_GT(asked_scenes_.back().width_px, 500);
  EXPECT_GT(asked_scenes_.back().height_px, 500);
  ASSERT_FALSE(asked_scopes_.empty());
  EXPECT_EQ(asked_scopes_.back().size(), 4U);
  EXPECT_TRUE(drawn().shows("palm inner force x · N"));
  EXPECT_TRUE(drawn().shows("Test fluid"));
  EXPECT_TRUE(drawn().shows("Show one finger."));
}

TEST_F(ApparatusView, OfADoubleBlindStudyItShowsOneSentenceAndAsksForNothing) {
  SessionView view = felt();
  view.hides_levels = true;
  view.blinding = experiments::Blinding::kDouble;
  draw(view);
  EXPECT_TRUE(drawn().shows("This study is double-blind"));
  EXPECT_TRUE(asked_scenes_.empty());
  EXPECT_TRUE(asked_scopes_.empty());
  for (const char* control : {"scene", "scope_1", "hold", "camera_above"}) {
    EXPECT_EQ(drawn().find(control), nullptr) << control;
  }
  const std::regex measured("[0-9] (N|N m|m|m/s|rad)( |$)");
  for (const std::string& text : drawn().texts) {
    EXPECT_FALSE(std::regex_search(text, measured)) << text;
  }
  EXPECT_NE(drawn().find("emergency_stop"), nullptr);
}

TEST_F(ApparatusView, WhoIsAloneAtTheMouseSeesNothingEither) {
  SessionView view = felt();
  view.is_alone = true;
  draw(view);
  EXPECT_TRUE(asked_scenes_.empty());
  EXPECT_TRUE(asked_scopes_.empty());
  EXPECT_EQ(drawn().find("apparatus"), nullptr) << "nor is there a way to it";
}

TEST_F(ApparatusView, TheEmergencyStopAndThePrintedKeyBackAreAlwaysThere) {
  draw(felt());
  EXPECT_EQ(drawn().find("emergency_stop")->key, "Esc");
  ui_.press(Key::kEscape);
  EXPECT_TRUE(draw(felt()).stop);
  ui_.press(letter('1'));
  draw(felt());
  ASSERT_NE(drawn().find("channel_typed"), nullptr) << "the chooser is open";
  ui_.click("emergency_stop");
  EXPECT_TRUE(draw(felt()).stop) << "also above a dialog";
  ui_.press(Key::kEscape);
  EXPECT_TRUE(draw(felt()).stop) << "also while something is typed";
  ui_.press(Key::kF2);
  draw(felt());
  EXPECT_EQ(drawn().find("apparatus")->key, "F4");
  ui_.press(Key::kF4);
  draw(felt());
  EXPECT_FALSE(run_.shows_apparatus);
}

TEST_F(ApparatusView, CommandsOfTheHeaderWorkAsInTheSession) {
  draw(felt());
  ui_.press(letter('P'));
  const RunViewResult result = draw(felt());
  ASSERT_EQ(result.requests.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<operate::Pause>(result.requests[0]));
}

TEST_F(ApparatusView, AFaultIsToldHereToo) {
  SessionView view = felt();
  view.step = Step::kFault;
  view.fault = "the device was unplugged";
  draw(view);
  EXPECT_TRUE(drawn().shows("the device was unplugged"));
}

TEST_F(ApparatusView, AChannelIsFoundByTypingAndTakenByEnter) {
  draw(felt());
  ui_.press(letter('3'));
  draw(felt());
  ui_.type("thumb velocity");
  draw(felt());
  ui_.press(Key::kDown);
  draw(felt());
  ui_.press(Key::kEnter);
  draw(felt());
  EXPECT_EQ(state_.scopes.channels[2], "thumb_velocity_y_m_per_s");
  EXPECT_EQ(drawn().find("channel_typed"), nullptr);
  EXPECT_EQ(asked_scopes_.back()[2], "thumb_velocity_y_m_per_s");
  EXPECT_TRUE(drawn().shows("thumb velocity y · m/s"));
}

TEST_F(ApparatusView, AChannelIsTakenByAClickAndLeftByItsKey) {
  draw(felt());
  ui_.click("scope_2");
  draw(felt());
  ui_.type("middle force");
  draw(felt());
  ui_.click("channel_middle_force_z_n");
  draw(felt());
  EXPECT_EQ(state_.scopes.channels[1], "middle_force_z_n");
  ui_.press(letter('2'));
  draw(felt());
  ui_.type("index");
  draw(felt());
  ui_.press(Key::kF2);
  draw(felt());
  EXPECT_EQ(state_.scopes.channels[1], "middle_force_z_n");
  EXPECT_FALSE(state_.scopes.choosing.has_value());
}

TEST_F(ApparatusView, WhatIsTypedBeginsTheChoiceAnew) {
  draw(felt());
  ui_.press(letter('1'));
  draw(felt());
  ui_.press(Key::kDown);
  ui_.press(Key::kDown);
  draw(felt());
  EXPECT_EQ(state_.scopes.selected, 2);
  ui_.type("index force");
  ui_.press(Key::kEnter);
  draw(felt());
  EXPECT_EQ(state_.scopes.channels[0], "index_force_x_n");
}

TEST_F(ApparatusView, ADragThatBeganElsewhereTurnsNothing) {
  draw(felt());
  const SceneCamera before = state_.camera;
  const Rect scene = drawn().find("scene")->place;
  ui_.move(scene.right() + 60, scene.y + 60);
  ui_.mouse_down();
  draw(felt());
  ui_.move(scene.x + 100, scene.y + 100);
  draw(felt());
  EXPECT_EQ(state_.camera, before);
  ui_.mouse_up();
}

TEST_F(ApparatusView, NothingMatchesAndEnterTakesNothing) {
  draw(felt());
  ui_.press(letter('1'));
  draw(felt());
  ui_.type("big toe");
  draw(felt());
  EXPECT_TRUE(drawn().shows("No channel has all of these words"));
  ui_.press(Key::kEnter);
  draw(felt());
  EXPECT_EQ(state_.scopes.channels[0], "palm_inner_position_x_m");
  EXPECT_TRUE(state_.scopes.choosing.has_value());
}

TEST_F(ApparatusView, JointsAreOfferedOnlyWhereThereAreAny) {
  bool has_joints = false;
  sources_.scopes = [&](const std::vector<std::string>& names) {
    ScopePicture picture = picture_of(names);
    picture.has_joints = has_joints;
    return picture;
  };
  draw(felt());
  ui_.press(letter('1'));
  draw(felt());
  ui_.type("arm torque");
  draw(felt());
  EXPECT_EQ(drawn().find("channel_arm_1_torque_n_m"), nullptr);
  has_joints = true;
  draw(felt());
  EXPECT_NE(drawn().find("channel_arm_1_torque_n_m"), nullptr);
}

TEST_F(ApparatusView, HeldItShowsWhatStoodThereAlsoOfOtherChannels) {
  draw(felt());
  ui_.press(letter('H'));
  draw(felt());
  ASSERT_TRUE(state_.held.has_value());
  const std::size_t asked = asked_scopes_.size();
  SessionView later = felt();
  later.telemetry.sample.tick = 9000;
  state_.scopes.channels[0] = "fault";
  draw(later);
  EXPECT_EQ(asked_scenes_.back().sample.tick, 77);
  EXPECT_EQ(asked_scopes_.size(), asked) << "nothing newer is looked at";
  EXPECT_TRUE(drawn().shows("5.00")) << "the channel's value, which is the length of its name";
  EXPECT_EQ(drawn().find("hold")->label, "Go on");
  ui_.press(letter('H'));
  draw(later);
  EXPECT_EQ(asked_scenes_.back().sample.tick, 9000);
}

TEST_F(ApparatusView, KeysTurnTheViewAndSetIt) {
  draw(felt());
  EXPECT_EQ(drawn().find("camera_above")->key, "A");
  ui_.press(letter('A'));
  draw(felt());
  EXPECT_EQ(state_.camera, camera_from_above());
  ui_.press(letter('S'));
  draw(felt());
  EXPECT_EQ(asked_scenes_.back().camera, camera_from_side());
  ui_.press(Key::kRight);
  ui_.press(Key::kPlus);
  draw(felt());
  EXPECT_GT(state_.camera.azimuth_rad, camera_from_side().azimuth_rad - 7.0);
  EXPECT_NE(state_.camera.azimuth_rad, camera_from_side().azimuth_rad);
  EXPECT_LT(state_.camera.distance_m, camera_from_side().distance_m);
  ui_.press(letter('R'));
  draw(felt());
  EXPECT_EQ(state_.camera, camera_at_first());
}

TEST_F(ApparatusView, TheMouseTurnsWhatItTookHoldOfAndTheWheelComesNearer) {
  draw(felt());
  const Rect scene = drawn().find("scene")->place;
  const SceneCamera before = state_.camera;
  ui_.move(scene.x + 100, scene.y + 100);
  draw(felt());
  EXPECT_EQ(state_.camera, before) << "nothing is held yet";
  ui_.mouse_down();
  draw(felt());
  ui_.move(scene.x + 150, scene.y + 130);
  draw(felt());
  EXPECT_NEAR(state_.camera.azimuth_rad, before.azimuth_rad - 50 * 0.008, 1e-6);
  EXPECT_NEAR(state_.camera.elevation_rad, before.elevation_rad - 30 * 0.008, 1e-6);
  ui_.mouse_up();
  draw(felt());
  const SceneCamera turned = state_.camera;
  ui_.move(scene.x + 300, scene.y + 300);
  draw(felt());
  EXPECT_EQ(state_.camera, turned) << "let go of";
  ui_.wheel(2);
  draw(felt());
  EXPECT_LT(state_.camera.distance_m, turned.distance_m);
}

TEST_F(ApparatusView, UnderTheMouseStandTheValuesOfThatTime) {
  sources_.scopes = [&](const std::vector<std::string>& names) {
    ScopePicture picture{.newest_s = 30.0};
    for (std::size_t i = 0; i < names.size(); ++i) {
      picture.channels.emplace_back();
      for (int point = 0; point <= 1000; ++point) {
        const auto value = static_cast<float>(point < 500 ? -1.25 : 2.5);
        picture.channels[i].push_back(
            {20.0 + 0.01 * point, value, value + (point == 0 ? 8 : 0)});
      }
    }
    return picture;
  };
  draw(felt());
  EXPECT_TRUE(drawn().shows("2.50 N")) << "the newest";
  EXPECT_FALSE(drawn().shows("1.25 N"));
  const Rect scope = drawn().find("scope_3")->place;
  ui_.move(scope.x + 150, scope.bottom() + 60);
  draw(felt());
  EXPECT_TRUE(drawn().shows("1.25 N"));
  EXPECT_TRUE(drawn().shows("1.25 m/s")) << "of every scope";
}

TEST_F(ApparatusView, WhyThereIsNoPictureStandsInItsPlaceAndTheScopesGoOn) {
  sources_.paint = nullptr;
  sources_.paint_problem = "3D view: expected OpenGL, found none";
  draw(felt());
  EXPECT_TRUE(drawn().shows("3D view: expected OpenGL, found none"));
  EXPECT_NE(drawn().find("scope_1"), nullptr);
  EXPECT_FALSE(asked_scopes_.empty());
}

TEST_F(ApparatusView, WhileThePictureLoadsItSaysSoAndEverythingElseIsThere) {
  sources_.paint = [](const SceneRequest&) { return std::uintptr_t{0}; };
  draw(felt());
  EXPECT_TRUE(drawn().shows("Loading the 3D view …"));
  EXPECT_FALSE(drawn().shows("picture of the apparatus"));
  EXPECT_NE(drawn().find("scope_1"), nullptr);
  EXPECT_NE(drawn().find("emergency_stop"), nullptr);
}

TEST_F(ApparatusView, EmptyAndBrokenChannelsAreDrawnAsSuch) {
  state_.scopes.channels = {"", "no_such_channel", "fault", "index_force_x_n"};
  sources_.scopes = [](const std::vector<std::string>& names) {
    ScopePicture picture{.newest_s = 1.0};
    picture.channels.resize(names.size());
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    picture.channels[2] = {{0.99, kNan, kNan}, {1.0, kNan, kNan}};
    picture.channels[3] = {{1.0, 3.0f, 3.0f}};
    return picture;
  };
  draw(felt());
  EXPECT_TRUE(drawn().shows("No channel"));
  EXPECT_TRUE(drawn().shows("No samples yet."));
  EXPECT_TRUE(drawn().shows("no number"));
  EXPECT_TRUE(drawn().shows("3.00 N"));
}

TEST_F(ApparatusView, NoiseOfNoInterestIsALineAndIsCalledZero) {
  sources_.scopes = [](const std::vector<std::string>& names) {
    ScopePicture picture{.newest_s = 1.0};
    picture.channels.resize(names.size());
    for (int point = 0; point < 100; ++point) {
      const auto noise = static_cast<float>(point % 2 == 0 ? 3e-19 : -8e-28);
      picture.channels[0].push_back({0.01 * point, noise, noise});
    }
    return picture;
  };
  draw(felt());
  EXPECT_TRUE(drawn().shows("0 m"));
  for (const std::string& text : drawn().texts) {
    EXPECT_EQ(text.find("×10"), std::string::npos) << text;
  }
}

TEST_F(ApparatusView, EverythingHasRoomInTheSmallestWindow) {
  HeadlessUi small(1024, 640);
  small.frame([&](Ui& ui) { (void)draw_apparatus_view(ui, felt(), sources_, run_, state_); });
  const Rect screen{0, 0, 1024, 640};
  for (const Drawn::Widget& widget : small.drawn().widgets) {
    EXPECT_GE(widget.place.x, 0) << widget.name;
    EXPECT_LE(widget.place.right(), screen.right()) << widget.name;
    EXPECT_LE(widget.place.bottom(), screen.bottom()) << widget.name;
    EXPECT_GT(widget.place.width * widget.place.height, 100) << widget.name;
  }
  for (std::size_t i = 0; i < small.drawn().widgets.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Rect both = small.drawn().widgets[i].place.common(small.drawn().widgets[j].place);
      EXPECT_LE(both.width * both.height, 0)
          << small.drawn().widgets[i].name << " over " << small.drawn().widgets[j].name;
    }
  }
}

}  // namespace apparatus_view_test
}  // namespace jnd::app::gui
