#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

struct ImFont;

namespace jnd::app::gui {

/// Fonts by their role. The numbers are the em square in logical pixels.
enum class Font {
  kTiny,         ///< 12; ticks of plots.
  kSmall,        ///< 14; the footer.
  kBody,         ///< 17.
  kStrong,       ///< 17, semi-bold.
  kLarge,        ///< 20, semi-bold; titles of cards.
  kTitle,        ///< 30, bold; the one sentence that says what to do.
  kHuge,         ///< 44, bold; the program's name, and what is typed.
  kCaps,         ///< 13, semi-bold, spaced; headings.
  kMono,         ///< 14, JetBrains Mono; numbers in tables.
  kSmallStrong,  ///< 14, semi-bold; chips, and what matters in the footer.
  kAnswer,       ///< 24, semi-bold; large buttons.
  kKeyCap,       ///< 12, JetBrains Mono, medium; caps of keys.
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
  kOnFilled,  ///< Words on a button that is filled with one of the five colours of meaning.
  kPilot,     ///< The frame around the whole window in a pilot session.
  kStop,      ///< The filled emergency stop; it is red in the dark mode as well.
  kOnStop,
};
inline constexpr int kNumColours = 14;

/// Every view has room in a window of this size, in logical pixels.
inline constexpr float kLeastWidth = 1024;
inline constexpr float kLeastHeight = 640;

/// Returns the scale that is wanted. If a window of so many pixels has no room for every view
/// at that scale, returns the largest scale at which it has, in steps of 1/20.
[[nodiscard]] float scale_with_room(float wanted, float width_px, float height_px) noexcept;

/// Fonts, colours and scale. People who see no red or green can tell the colours apart, and
/// every colour comes with a word or a shape. Every colour of words has a contrast of at least
/// 4.5 : 1 (WCAG 2.1, AA) on each ground it is used on, in both modes.
class Theme {
 public:
  /// `scale` is the monitor's scale times the person's choice.
  explicit Theme(float scale = 1.0f, bool dark = false);

  /// Builds the font atlas of ImGui's current context for the scale; call it again, outside of
  /// a frame, after the scale has changed. A missing font file is replaced by another one and
  /// named in `missing_fonts`. `roles` restricts what is built to these roles, where not
  /// everything is drawn; each other role then gets the font of the nearest size. An empty
  /// `roles` builds all.
  void load_fonts(std::span<const Font> roles = {});
  [[nodiscard]] const std::vector<std::string>& missing_fonts() const noexcept {
    return missing_;
  }

  [[nodiscard]] bool dark() const noexcept { return dark_; }
  void set_dark(bool dark) noexcept { dark_ = dark; }
  [[nodiscard]] float scale() const noexcept { return scale_; }
  /// The scale is limited to 0.5 to 4 and takes effect with `load_fonts`.
  void set_scale(float scale) noexcept;
  [[nodiscard]] bool fonts_are_stale() const noexcept { return fonts_scale_ != scale_; }

  /// The colour as ImGui packs it.
  [[nodiscard]] std::uint32_t rgba(Colour colour, float alpha = 1.0f) const noexcept;
  /// The colour for lines and bars, which need less contrast than words (3 : 1) and so can be
  /// clearer.
  [[nodiscard]] std::uint32_t line_rgba(Colour colour, float alpha = 1.0f) const noexcept;
  /// The colour as 0xRRGGBB.
  [[nodiscard]] std::uint32_t rgb(Colour colour) const noexcept;
  [[nodiscard]] ImFont* font(Font font) const noexcept;
  [[nodiscard]] float size(Font font) const noexcept;  ///< The em square in logical pixels.

 private:
  float scale_ = 1.0f;
  bool dark_;
  float fonts_scale_ = 0.0f;
  std::array<ImFont*, kNumFonts> fonts_{};
  std::vector<std::string> missing_;
};

/// The scale of a window that is read from afar and whose letters grow with its size. At least
/// 1024 x 600 logical pixels fit into the window if the scale is more than its least value. It
/// goes from 0.5 to 2.5 in steps, so that resizing does not make new letters all the time.
[[nodiscard]] float scale_from_afar(int width_px, int height_px) noexcept;

/// How opaque a chip's ground is; it has the colour of the chip's words.
inline constexpr float kChipAlpha = 0.12f;

}  // namespace jnd::app::gui
