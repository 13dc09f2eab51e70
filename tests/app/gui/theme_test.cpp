#include "app/gui/theme.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/gui/headless_ui.h"

namespace jnd::app::gui {
namespace theme_test {

struct Rgb {
  double red, green, blue;  // Each is 0 to 255.
};

Rgb rgb(const Theme& theme, Colour colour) {
  const std::uint32_t value = theme.rgb(colour);
  return {double(value >> 16 & 0xff), double(value >> 8 & 0xff), double(value & 0xff)};
}

Rgb over(const Rgb& above, const Rgb& below, double alpha) {
  const auto mix = [&](double a, double b) { return alpha * a + (1 - alpha) * b; };
  return {mix(above.red, below.red), mix(above.green, below.green),
          mix(above.blue, below.blue)};
}

// WCAG 2.1 defines relative luminance and contrast ratio.
double luminance(const Rgb& colour) {
  const auto linear = [](double value) {
    const double c = value / 255;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(colour.red) + 0.7152 * linear(colour.green) +
         0.0722 * linear(colour.blue);
}

double contrast(const Rgb& a, const Rgb& b) {
  const double brighter = std::max(luminance(a), luminance(b));
  const double darker = std::min(luminance(a), luminance(b));
  return (brighter + 0.05) / (darker + 0.05);
}

constexpr double kReadable = 4.5;  // The minimum contrast of text in WCAG 2.1, level AA.
constexpr Colour kMeanings[] = {Colour::kBlue, Colour::kGreen, Colour::kAmber, Colour::kRed,
                                Colour::kPilot};

TEST(Theme, TheContrastHereIsThatOfWcag) {
  EXPECT_NEAR(contrast({0, 0, 0}, {255, 255, 255}), 21.0, 1e-12);
  // This is the well-known #777.
  EXPECT_NEAR(contrast({119, 119, 119}, {255, 255, 255}), 4.48, 0.005);
}

TEST(Theme, WordsAreReadableOnEveryGroundInBothModes) {
  for (const bool dark : {false, true}) {
    const Theme theme(1.0f, dark);
    for (const Colour ground : {Colour::kGround, Colour::kCard, Colour::kBlueSoft}) {
      for (const Colour words : {Colour::kInk, Colour::kSoft, Colour::kBlue, Colour::kGreen,
                                 Colour::kAmber, Colour::kRed, Colour::kPilot}) {
        EXPECT_GE(contrast(rgb(theme, words), rgb(theme, ground)), kReadable)
            << "dark " << dark << ", words " << int(words) << " on " << int(ground);
      }
    }
  }
}

TEST(Theme, WordsAreReadableOnChipsOfTheirOwnColour) {
  for (const bool dark : {false, true}) {
    const Theme theme(1.0f, dark);
    for (const Colour words : kMeanings) {
      for (const Colour below : {Colour::kCard, Colour::kGround}) {
        const Rgb chip = over(rgb(theme, words), rgb(theme, below), kChipAlpha);
        EXPECT_GE(contrast(rgb(theme, words), chip), kReadable)
            << "dark " << dark << ", words " << int(words) << " over " << int(below);
      }
    }
  }
}

TEST(Theme, WordsAreReadableOnFilledButtons) {
  for (const bool dark : {false, true}) {
    const Theme theme(1.0f, dark);
    for (const Colour fill : kMeanings) {
      EXPECT_GE(contrast(rgb(theme, Colour::kOnFilled), rgb(theme, fill)), kReadable)
          << "dark " << dark << ", fill " << int(fill);
    }
    EXPECT_GE(contrast(rgb(theme, Colour::kOnStop), rgb(theme, Colour::kStop)), kReadable);
    EXPECT_GE(contrast(rgb(theme, Colour::kCard), rgb(theme, Colour::kInk)), kReadable);
  }
}

TEST(Theme, LinesStandOutFromTheCard) {
  constexpr double kVisible = 3.0;  // WCAG 2.1, 1.4.11: graphical objects.
  for (const bool dark : {false, true}) {
    const Theme theme(1.0f, dark);
    for (const Colour colour : kMeanings) {
      const std::uint32_t packed = theme.line_rgba(colour);
      const Rgb line = {double(packed & 0xff), double(packed >> 8 & 0xff),
                        double(packed >> 16 & 0xff)};
      EXPECT_GE(contrast(line, rgb(theme, Colour::kCard)), kVisible)
          << "dark " << dark << ", line " << int(colour);
    }
  }
}

TEST(Theme, PacksColoursAsImGuiDoes) {
  const Theme theme;
  EXPECT_EQ(theme.rgb(Colour::kBlue), 0x2563b0u);
  EXPECT_EQ(theme.rgba(Colour::kBlue),
            static_cast<std::uint32_t>(IM_COL32(0x25, 0x63, 0xb0, 255)));
  EXPECT_EQ(theme.rgba(Colour::kBlue, 0.5f) >> 24, 128u);
}

TEST(Theme, LinesCanBeToldFromTheCardForThoseWhoSeeNoRedOrGreen) {
  // Plots use blue and amber. They also differ in blue against the other colours, the axis that
  // a red-green deficiency keeps.
  for (const bool dark : {false, true}) {
    const Theme theme(1.0f, dark);
    const Rgb blue = rgb(theme, Colour::kBlue);
    const Rgb amber = rgb(theme, Colour::kAmber);
    const auto blueness = [](const Rgb& c) { return c.blue - (c.red + c.green) / 2; };
    EXPECT_GT(blueness(blue) - blueness(amber), 100) << dark;
  }
}

TEST(Theme, ScaleStaysWhereLettersCanBeReadAndDrawn) {
  Theme theme(100.0f);
  EXPECT_EQ(theme.scale(), 4.0f);
  theme.set_scale(0.0f);
  EXPECT_EQ(theme.scale(), 0.5f);
  theme.set_scale(NAN);
  EXPECT_EQ(theme.scale(), 1.0f);
  EXPECT_TRUE(theme.fonts_are_stale());
}

TEST(Theme, LettersGrowAsFarAsEveryViewHasRoom) {
  EXPECT_EQ(scale_with_room(1.0f, 1024, 640), 1.0f);
  EXPECT_EQ(scale_with_room(2.0f, 1024, 640), 1.0f);
  EXPECT_EQ(scale_with_room(0.5f, 1024, 640), 0.5f);
  // 1280 / 1024 is 1.25, and 700 / 640 is a little more than 1.05.
  EXPECT_EQ(scale_with_room(2.0f, 1280, 800), 1.25f);
  EXPECT_EQ(scale_with_room(2.0f, 1280, 700), 1.05f);
  EXPECT_EQ(scale_with_room(2.0f, 3840, 2160), 2.0f);
}

TEST(Theme, EveryFontHasTheSignsThatUnitsKeysAndNamesNeed) {
  HeadlessUi ui;
  for (int font = 0; font < kNumFonts; ++font) {
    const ImFont* loaded = ui.theme().font(static_cast<Font>(font));
    ASSERT_NE(loaded, nullptr) << font;
    for (const int c : {0x41, 0xe4, 0xdf, 0x142, 0xb5, 0xb7, 0xb1, 0xb2, 0x2013, 0x201c, 0x201e,
                        0x2026, 0x2191, 0x2212, 0x2265, 0x3b1}) {
      EXPECT_NE(loaded->FindGlyphNoFallback(static_cast<ImWchar>(c)), nullptr)
          << "font " << font << ", " << c;
    }
  }
  EXPECT_FALSE(ui.theme().fonts_are_stale());
}

TEST(Theme, AFontsSizeIsItsEmSquareAtEveryScale) {
  // Inter's capital H has a height of 0.727 em.
  for (const float scale : {1.0f, 1.5f, 2.0f}) {
    HeadlessUi ui(800, 600, scale);
    if (!ui.theme().missing_fonts().empty()) GTEST_SKIP() << ui.theme().missing_fonts().front();
    const ImFontGlyph* glyph = ui.theme().font(Font::kHuge)->FindGlyph('H');
    EXPECT_NEAR(glyph->Y1 - glyph->Y0, 0.727f * 44 * scale, 1.6f) << scale;
  }
}

}  // namespace theme_test
}  // namespace jnd::app::gui
