#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

struct ImFont;

namespace jnd::app::gui {

/// By role; the numbers are logical pixels of the em square.
enum class Font {
  kTiny,         ///< 12, ticks of plots.
  kSmall,        ///< 14, footer.
  kBody,         ///< 17.
  kStrong,       ///< 17, semi-bold.
  kLarge,        ///< 20, semi-bold: titles of cards.
  kTitle,        ///< 30, bold: the one sentence.
  kHuge,         ///< 44, bold: the name, what is typed.
  kCaps,         ///< 13, semi-bold, spaced: headings.
  kMono,         ///< 14, JetBrains Mono: numbers in tables.
  kSmallStrong,  ///< 14, semi-bold: chips, what counts in the footer.
  kAnswer,       ///< 24, semi-bold: large buttons.
  kKeyCap,       ///< 12, JetBrains Mono, medium.
};
inline constexpr int kNumFonts = 12;

enum class Colour {
  kGround,
  kCard,
  kInk,
  kSoft,
  kLine,
  kBlue,
  kBlueSoft,
  kGreen,
  kAmber,
  kRed,
  kOnFilled,  ///< Words on a button filled with any of the five colours of meaning.
  kPilot,     ///< The whole frame of a pilot session.
  kStop,      ///< The emergency stop, filled; as red in the dark as by day.
  kOnStop,
};
inline constexpr int kNumColours = 14;

/// What every view has room for, logical pixels.
inline constexpr float kLeastWidth = 1024;
inline constexpr float kLeastHeight = 640;

/// The scale that is wanted, or the largest, in steps of a twentieth, at which a window of so
/// many pixels still has room for every view.
[[nodiscard]] float scale_with_room(float wanted, float width_px, float height_px) noexcept;

/// Fonts, colours and scale. Colours are told apart by those who see no red or green, and every
/// one stands with a word or a shape besides. Every colour of words has a contrast of at least
/// 4.5 : 1 (WCAG 2.1, AA) on each ground it stands on, in both modes.
class Theme {
 public:
  /// `scale`: of the monitor, times what the person chose.
  explicit Theme(float scale = 1.0f, bool dark = false);

  /// Builds the font atlas of ImGui's current context for the scale; after it changed, outside
  /// of a frame. Missing font files are replaced by what there is and named in `missing_fonts`.
  /// `roles`: these alone, where not everything is drawn; the one of the nearest size then
  /// stands for each of the others. All where it is empty.
  void load_fonts(std::span<const Font> roles = {});
  [[nodiscard]] const std::vector<std::string>& missing_fonts() const noexcept {
    return missing_;
  }

  [[nodiscard]] bool dark() const noexcept { return dark_; }
  void set_dark(bool dark) noexcept { dark_ = dark; }
  [[nodiscard]] float scale() const noexcept { return scale_; }
  /// Takes effect with `load_fonts`; within 0.5 to 4.
  void set_scale(float scale) noexcept;
  [[nodiscard]] bool fonts_are_stale() const noexcept { return fonts_scale_ != scale_; }

  /// As ImGui packs it.
  [[nodiscard]] std::uint32_t rgba(Colour colour, float alpha = 1.0f) const noexcept;
  /// For lines and bars, which need less contrast than words (3 : 1) and so can be clearer.
  [[nodiscard]] std::uint32_t line_rgba(Colour colour, float alpha = 1.0f) const noexcept;
  /// 0xRRGGBB
  [[nodiscard]] std::uint32_t rgb(Colour colour) const noexcept;
  [[nodiscard]] ImFont* font(Font font) const noexcept;
  [[nodiscard]] float size(Font font) const noexcept;  ///< Logical pixels of the em square.

 private:
  float scale_ = 1.0f;
  bool dark_;
  float fonts_scale_ = 0.0f;
  std::array<ImFont*, kNumFonts> fonts_{};
  std::vector<std::string> missing_;
};

/// The scale of a window that is read from afar, whose letters grow with it: at least 1024 x
/// 600 logical pixels have room in it, at any size. From 0.5 to 2.5, in steps, so that a window
/// that is being resized does not make new letters all the time.
[[nodiscard]] float scale_from_afar(int width_px, int height_px) noexcept;

/// How opaque the ground of a chip is, of the colour of its words.
inline constexpr float kChipAlpha = 0.12f;

}  // namespace jnd::app::gui
