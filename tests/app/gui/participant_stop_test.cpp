#include "app/gui/participant_stop.h"

#include <gtest/gtest.h>

namespace jnd::app::gui {
namespace participant_stop_test {

using Way = ParticipantStop::Way;

TEST(ParticipantStop, PressedItStops) {
  ParticipantStop stop(Key::kF10, Way::kPress);
  EXPECT_FALSE(stop.is_let_go()) << "nobody has to hold it";
  EXPECT_FALSE(stop.key_changed(Key::kF11, true)) << "another key";
  EXPECT_TRUE(stop.key_changed(Key::kF10, true));
  EXPECT_FALSE(stop.key_changed(Key::kF10, false));
}

TEST(ParticipantStop, HeldItLetsForceBeAndLetGoItStops) {
  ParticipantStop stop(Key::kF12, Way::kHold);
  EXPECT_TRUE(stop.is_let_go()) << "before anybody holds it";
  EXPECT_FALSE(stop.key_changed(Key::kF12, true));
  EXPECT_FALSE(stop.is_let_go());
  EXPECT_FALSE(stop.key_changed(Key::kF10, false)) << "another key";
  EXPECT_TRUE(stop.key_changed(Key::kF12, false));
  EXPECT_TRUE(stop.is_let_go());
}

TEST(ParticipantStop, WhereThereIsNoneNothingStops) {
  ParticipantStop stop(ParticipantStop::key_named("Esc"), Way::kHold);
  EXPECT_FALSE(stop.is_let_go());
  EXPECT_FALSE(stop.key_changed(Key::kF10, true));
  EXPECT_FALSE(stop.key_changed(Key::kF10, false));
  EXPECT_EQ(ParticipantStop::key_named("F11"), Key::kF11);
}

}  // namespace participant_stop_test
}  // namespace jnd::app::gui
