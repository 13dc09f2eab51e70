#include "app/gui/theme.h"

#include <algorithm>
#include <cmath>

namespace jnd::app::gui {
namespace {

using Palette = std::array<std::uint32_t, kNumColours>;

// The colours are in the order of `Colour`. In the light mode, the colours of meaning are
// darker than a fill would need, because words in them also stand on chips of their own tint.
constexpr Palette kLight = {0xf4f5f7, 0xffffff, 0x1c2430, 0x5d6878, 0xdfe3e9,
                            0x2563b0, 0xe7effa, 0x17724f, 0x8a5605, 0xb52626,
                            0xffffff, 0x7a3ea8, 0xc62f2f, 0xffffff};
constexpr Palette kDark = {0x14181f, 0x1d232d, 0xe8ecf2, 0x98a3b3, 0x303947,
                           0x6aa5ee, 0x22344d, 0x4cc39a, 0xe5a948, 0xee8680,
                           0x0e131a, 0xc49bea, 0xd03f3f, 0xffffff};

constexpr std::uint32_t kLightAmberLine = 0xb5720b;

std::uint32_t packed(std::uint32_t rgb, float alpha) {
  const std::uint32_t red = rgb >> 16 & 0xff;
  const std::uint32_t green = rgb >> 8 & 0xff;
  const std::uint32_t blue = rgb & 0xff;
  const auto opacity =
      static_cast<std::uint32_t>(std::lround(255.0f * std::clamp(alpha, 0.0f, 1.0f)));
  return opacity << 24 | blue << 16 | green << 8 | red;
}

}  // namespace

float scale_with_room(float wanted, float width_px, float height_px) noexcept {
  constexpr float kSteps = 20, kRounding = 1e-3f;
  const float most = std::min(width_px / kLeastWidth, height_px / kLeastHeight);
  if (!(wanted > most)) return wanted;
  return std::floor(most * kSteps + kRounding) / kSteps;
}

Theme::Theme(float scale, bool dark) : dark_(dark) { set_scale(scale); }

void Theme::set_scale(float scale) noexcept {
  scale_ = std::isfinite(scale) ? std::clamp(scale, 0.5f, 4.0f) : 1.0f;
}

float scale_from_afar(int width_px, int height_px) noexcept {
  constexpr float kWidth = 1024;
  constexpr float kHeight = 600;
  constexpr float kStep = 0.25f;
  // At this scale letters are large enough; larger ones take long to make.
  constexpr float kLargest = 2.5f;
  const float fitting =
      std::min(static_cast<float>(width_px) / kWidth, static_cast<float>(height_px) / kHeight);
  return std::clamp(std::floor(fitting / kStep) * kStep, 0.5f, kLargest);
}

std::uint32_t Theme::rgb(Colour colour) const noexcept {
  return (dark_ ? kDark : kLight)[static_cast<std::size_t>(colour)];
}

std::uint32_t Theme::rgba(Colour colour, float alpha) const noexcept {
  return packed(rgb(colour), alpha);
}

std::uint32_t Theme::line_rgba(Colour colour, float alpha) const noexcept {
  if (colour == Colour::kAmber && !dark_) return packed(kLightAmberLine, alpha);
  return rgba(colour, alpha);
}

ImFont* Theme::font(Font font) const noexcept { return fonts_[static_cast<std::size_t>(font)]; }

}  // namespace jnd::app::gui
