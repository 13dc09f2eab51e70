#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_ADVANCES_H
#include <imgui.h>
#include <imgui_freetype.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "app/gui/theme.h"

namespace jnd::app::gui {
namespace {

enum class Cut { kRegular, kSemiBold, kBold, kMono, kMonoMedium };

struct FontRole {
  Cut cut;
  float size;           ///< The em square in logical pixels.
  float spacing_ratio;  ///< Space added between letters, as a share of the em square.
};

// The roles are in the order of `Font`.
constexpr std::array<FontRole, kNumFonts> kRoles = {{
    {Cut::kRegular, 12, 0},
    {Cut::kRegular, 14, 0},
    {Cut::kRegular, 17, 0},
    {Cut::kSemiBold, 17, 0},
    {Cut::kSemiBold, 20, 0},
    {Cut::kBold, 30, -0.01f},
    {Cut::kBold, 44, -0.015f},
    {Cut::kSemiBold, 13, 0.08f},
    {Cut::kMono, 14, 0},
    {Cut::kSemiBold, 14, 0},
    {Cut::kSemiBold, 24, 0},
    {Cut::kMonoMedium, 12, 0},
}};

/// Font files for this cut. The first one that exists is used; the others replace it if it is
/// not installed.
std::vector<std::string> files_of(Cut cut) {
  const std::string inter = "/usr/share/fonts/opentype/inter/Inter-";
  const std::string mono = "/usr/share/fonts/truetype/jetbrains-mono/JetBrainsMono-";
  const std::string dejavu = "/usr/share/fonts/truetype/dejavu/DejaVuSans";
  const std::string liberation = "/usr/share/fonts/truetype/liberation/LiberationSans-";
  switch (cut) {
    case Cut::kRegular:
      return {inter + "Regular.otf", dejavu + ".ttf", liberation + "Regular.ttf"};
    case Cut::kSemiBold:
      return {inter + "SemiBold.otf", dejavu + "-Bold.ttf", liberation + "Bold.ttf"};
    case Cut::kBold:
      return {inter + "Bold.otf", dejavu + "-Bold.ttf", liberation + "Bold.ttf"};
    case Cut::kMono:
      return {mono + "Regular.ttf", dejavu + "Mono.ttf"};
    case Cut::kMonoMedium:
      return {mono + "Medium.ttf", mono + "Regular.ttf", dejavu + "Mono.ttf"};
  }
  return {};
}

// The glyphs of European languages, Greek and Cyrillic, and the signs of units, keys and plots.
constexpr ImWchar kGlyphs[] = {0x0020, 0x017f,  // Latin
                               0x0386, 0x03ce,  // Greek
                               0x0400, 0x045f,  // Cyrillic
                               0x1e9e, 0x1e9e,  // capital sharp s
                               0x2010, 0x2026,  // dashes, quotes, bullet, ellipsis
                               0x2030, 0x203a,  // per mille, primes, pointed quotes
                               0x2070, 0x209c,  // superscripts, subscripts
                               0x20ac, 0x20ac,  // euro
                               0x2122, 0x2122,  // trade mark
                               0x2190, 0x2199,  // arrows
                               0x21a9, 0x21b5, 0x21e7, 0x21e7, 0x2206, 0x2206, 0x2212,
                               0x2212, 0x221a, 0x221e, 0x2248, 0x2248, 0x2260, 0x2265,
                               0x232b, 0x232b, 0x23ce, 0x23ce, 0x25a0, 0x25cf, 0x2713,
                               0x2717, 0xfffd, 0xfffd, 0};

class FreeType {
 public:
  FreeType() { FT_Init_FreeType(&library_); }
  ~FreeType() { FT_Done_FreeType(library_); }
  FreeType(const FreeType&) = delete;
  FreeType& operator=(const FreeType&) = delete;
  [[nodiscard]] FT_Library library() const { return library_; }

 private:
  FT_Library library_ = nullptr;
};

struct CloseFace {
  void operator()(FT_Face face) const { FT_Done_Face(face); }
};
using Face = std::unique_ptr<FT_FaceRec_, CloseFace>;

struct FoundFont {
  std::string file;
  Face face;  ///< Empty if no file was found.
};

FoundFont find_font(FT_Library library, Cut cut, std::vector<std::string>& missing) {
  for (const std::string& file : files_of(cut)) {
    FT_Face face = nullptr;
    if (FT_New_Face(library, file.c_str(), 0, &face) == 0) return {file, Face(face)};
    if (std::ranges::find(missing, file) == missing.end()) missing.push_back(file);
  }
  return {};
}

/// ImGui calls the height of a line a font's size, while we mean the em square, as is usual.
/// ImGui cuts the height to whole pixels, so it is rounded here.
float line_px(FT_Face face, float em_px) {
  const float line = static_cast<float>(face->ascender - face->descender);
  return std::round(em_px * line / static_cast<float>(face->units_per_EM));
}

/// Sets the font's own advances. ImGui's FreeType builder rounds each one up to a whole pixel,
/// which makes text too wide and uneven.
void correct_advances(ImFont& font, FT_Face face, float line, float spacing_px) {
  const float em_px = line * static_cast<float>(face->units_per_EM) /
                      static_cast<float>(face->ascender - face->descender);
  for (ImFontGlyph& glyph : font.Glyphs) {
    const FT_UInt index = FT_Get_Char_Index(face, glyph.Codepoint);
    FT_Fixed advance = 0;
    if (index == 0 || FT_Get_Advance(face, index, FT_LOAD_NO_SCALE, &advance) != 0) continue;
    glyph.AdvanceX = spacing_px + em_px * static_cast<float>(advance) /
                                      static_cast<float>(face->units_per_EM);
    if (static_cast<int>(glyph.Codepoint) < font.IndexAdvanceX.Size) {
      font.IndexAdvanceX[static_cast<int>(glyph.Codepoint)] = glyph.AdvanceX;
    }
  }
}

/// The wanted role whose letter size is nearest to that of this one.
std::size_t nearest_in_size(std::size_t role, const std::array<bool, kNumFonts>& is_wanted) {
  std::size_t nearest = role;
  for (std::size_t i = 0; i < kRoles.size(); ++i) {
    if (!is_wanted[i]) continue;
    const float away = std::abs(kRoles[i].size - kRoles[role].size);
    if (nearest == role || away < std::abs(kRoles[nearest].size - kRoles[role].size)) {
      nearest = i;
    }
  }
  return nearest;
}

}  // namespace

float Theme::size(Font font) const noexcept {
  return kRoles[static_cast<std::size_t>(font)].size;
}

void Theme::load_fonts(std::span<const Font> roles) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.Clear();
  atlas.FontBuilderIO = ImGuiFreeType::GetBuilderForFreeType();
  atlas.FontBuilderFlags = ImGuiFreeTypeBuilderFlags_LightHinting;
  missing_.clear();
  const FreeType free_type;
  std::array<FoundFont, kNumFonts> found;
  std::array<float, kNumFonts> lines{};
  std::array<bool, kNumFonts> is_wanted{};
  is_wanted.fill(roles.empty());
  for (const Font role : roles) is_wanted[static_cast<std::size_t>(role)] = true;
  for (std::size_t i = 0; i < kRoles.size(); ++i) {
    if (!is_wanted[i]) continue;
    const float em_px = kRoles[i].size * scale_;
    found[i] = find_font(free_type.library(), kRoles[i].cut, missing_);
    if (found[i].face == nullptr) {
      ImFontConfig config;
      config.SizePixels = std::max(8.0f, std::round(em_px));
      fonts_[i] = atlas.AddFontDefault(&config);
      continue;
    }
    lines[i] = line_px(found[i].face.get(), em_px);
    fonts_[i] = atlas.AddFontFromFileTTF(found[i].file.c_str(), lines[i], nullptr, kGlyphs);
  }
  atlas.Build();
  for (std::size_t i = 0; i < kRoles.size(); ++i) {
    if (found[i].face == nullptr) continue;
    correct_advances(*fonts_[i], found[i].face.get(), lines[i],
                     kRoles[i].spacing_ratio * kRoles[i].size * scale_);
  }
  for (std::size_t i = 0; i < kRoles.size(); ++i) {
    if (!is_wanted[i]) fonts_[i] = fonts_[nearest_in_size(i, is_wanted)];
  }
  ImGui::GetIO().FontDefault = font(Font::kBody);
  fonts_scale_ = scale_;
}

}  // namespace jnd::app::gui
