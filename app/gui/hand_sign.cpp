#include "app/gui/hand_sign.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace jnd::app::gui {
namespace {

// The signs are drawn on a square of 100 by 100 with y downwards. They show the right hand as a
// person opposite its owner sees it.
constexpr float kStroke = 3.8f;
constexpr int kCirclePoints = 40;

/// All points within a radius of the convex hull of some points. One point makes a disc, two
/// make a finger, four a palm.
struct Blob {
  std::vector<ImVec2> points;
  float radius = 0;
};

/// Blobs with one common outline. A sign consists of parts, each drawn over the ones before it.
using Part = std::vector<Blob>;
struct Drawing {
  std::vector<Part> parts;
  std::vector<Blob> creases;  ///< Filled with ink, on top of the parts.
};

float cross(const ImVec2& origin, const ImVec2& a, const ImVec2& b) {
  return (a.x - origin.x) * (b.y - origin.y) - (a.y - origin.y) * (b.x - origin.x);
}

/// The convex hull by Andrew's monotone chain. It goes clockwise on a screen, as ImGui needs it
/// to draw soft edges.
std::vector<ImVec2> convex_hull(std::vector<ImVec2> points) {
  std::ranges::sort(points, [](const ImVec2& a, const ImVec2& b) {
    return a.x < b.x || (a.x == b.x && a.y < b.y);
  });
  std::vector<ImVec2> hull;
  const auto half = [&](auto begin, auto end) {
    const std::size_t start = hull.size();
    for (auto point = begin; point != end; ++point) {
      while (hull.size() >= start + 2 &&
             cross(hull[hull.size() - 2], hull.back(), *point) <= 0) {
        hull.pop_back();
      }
      hull.push_back(*point);
    }
    hull.pop_back();
  };
  half(points.begin(), points.end());
  half(points.rbegin(), points.rend());
  return hull;
}

/// A finger that is bent along a circle. The angles are in degrees, clockwise from the right.
Part bent_finger(ImVec2 centre, float bend, float from_deg, float to_deg, float radius) {
  constexpr int kPieces = 36;
  const auto at = [&](int i) {
    const float share = static_cast<float>(i) / kPieces;
    const float angle =
        (from_deg + share * (to_deg - from_deg)) * std::numbers::pi_v<float> / 180;
    return ImVec2(centre.x + bend * std::cos(angle), centre.y + bend * std::sin(angle));
  };
  Part part;
  for (int i = 0; i < kPieces; ++i) part.push_back({{at(i), at(i + 1)}, radius});
  return part;
}

Part joined(std::initializer_list<Part> parts) {
  Part all;
  for (const Part& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

Drawing fist() {
  const Part palm = {{{{31.2f, 60}, {68.9f, 60}, {64, 80}, {38, 80}}, 11}};
  return {.parts = {palm,
                    {{{{72.5f, 38}, {72.5f, 57}}, 7.4f}},
                    {{{{58.5f, 33}, {58.5f, 57}}, 7.6f}},
                    {{{{43.5f, 32}, {43.5f, 57}}, 7.8f}},
                    {{{{28, 36}, {28, 57}}, 7.8f}},
                    {{{{27, 70}, {55, 66}}, 7.8f}}},
          .creases = {}};
}

Drawing one_finger() {
  const Part palm = {{{{32, 63}, {69.5f, 63}, {64, 82}, {39, 82}}, 11.5f}};
  return {.parts = {palm,
                    {{{{74, 45}, {74, 59}}, 7.2f}},
                    {{{{60.5f, 41}, {60.5f, 60}}, 7.5f}},
                    {{{{46.5f, 40}, {46.5f, 60}}, 7.7f}},
                    {{{{30.5f, 15}, {30.5f, 64}}, 8.2f}},
                    {{{{27, 74}, {54, 68}}, 7.8f}}},
          .creases = {}};
}

Drawing two_fingers() {
  const Part palm = {{{{32, 63}, {69.5f, 63}, {64, 82}, {39, 82}}, 11.5f}};
  return {.parts = {palm,
                    {{{{74, 45}, {74, 59}}, 7.2f}},
                    {{{{60.5f, 41}, {60.5f, 60}}, 7.5f}},
                    {{{{48, 62}, {56, 13}}, 7.9f}},
                    {{{{30.5f, 64}, {25, 17}}, 8}},
                    {{{{27, 74}, {54, 68}}, 7.8f}}},
          .creases = {}};
}

Drawing three_fingers() {
  const Part palm = {{{{32, 63}, {69.5f, 63}, {64, 82}, {39, 82}}, 11.5f}};
  return {.parts = {palm,
                    {{{{74, 45}, {74, 59}}, 7.2f}},
                    {{{{62, 62}, {72, 17}}, 7.6f}},
                    {{{{47, 62}, {49, 12}}, 7.9f}},
                    {{{{30.5f, 64}, {25, 17}}, 8}},
                    {{{{27, 74}, {54, 68}}, 7.8f}}},
          .creases = {}};
}

Drawing okay() {
  const Part palm = {{{{54, 60}, {70, 62}, {64, 82}, {52, 82}}, 11}};
  const Part fingers = {
      {{{54, 58}, {50, 16}}, 6.6f}, {{{64, 58}, {68, 14}}, 6.6f}, {{{72, 62}, {86, 26}}, 6.3f}};
  // Index finger and thumb form one ring; a line separates them where their tips meet.
  const Part ring = bent_finger({31, 57}, 16, 0, 360, 6.6f);
  const Part thumb = {{{{42, 71.5f}, {54, 80}}, 7.5f}};
  return {.parts = {joined({palm, fingers, thumb, ring})},
          .creases = {{{{8.5f, 59.5f}, {20, 57}}, kStroke / 2}}};
}

Drawing thumb_up() {
  const Part cuff = {{{{13, 52}, {21, 52}, {21, 86}, {13, 86}}, 4}};
  const Part hand_and_thumb = {{{{33, 58}, {60, 54}, {60, 80}, {33, 80}}, 8},
                               {{{40, 56}, {50, 20}}, 8.2f},
                               {{{34, 60}, {44, 42}}, 8.2f}};
  return {.parts = {cuff,
                    hand_and_thumb,
                    {{{{57, 86}, {72, 86}}, 6.2f}},
                    {{{{55, 73.5f}, {76, 73.5f}}, 6.8f}},
                    {{{{54, 60.5f}, {79, 60.5f}}, 6.8f}},
                    {{{{55, 47}, {79, 47}}, 6.8f}}},
          .creases = {}};
}

Drawing open_hand() {
  return {.parts = {{{{{36, 62}, {68, 62}, {62, 82}, {44, 82}}, 11},
                     {{{33, 60}, {26, 24}}, 6.6f},
                     {{{46, 56}, {44, 13}}, 6.8f},
                     {{{59, 56}, {63, 15}}, 6.6f},
                     {{{72, 62}, {82, 30}}, 6.2f},
                     {{{42, 80}, {13, 58}}, 6.8f}}},
          .creases = {}};
}

Drawing upside_down(Drawing drawing) {
  const auto turn = [](Blob& blob) {
    for (ImVec2& point : blob.points) point.y = 100 - point.y;
  };
  for (Part& part : drawing.parts) std::ranges::for_each(part, turn);
  std::ranges::for_each(drawing.creases, turn);
  return drawing;
}

Drawing drawing_of(HandSign sign) {
  switch (sign) {
    case HandSign::kNone:
      break;
    case HandSign::kFist:
      return fist();
    case HandSign::kOneFinger:
      return one_finger();
    case HandSign::kTwoFingers:
      return two_fingers();
    case HandSign::kThreeFingers:
      return three_fingers();
    case HandSign::kReady:
    case HandSign::kMatches:
      return okay();
    case HandSign::kRaise:
      return thumb_up();
    case HandSign::kLower:
      return upside_down(thumb_up());
    case HandSign::kOpenHand:
      return open_hand();
  }
  return {};
}

/// Draws blobs into a square on the screen, enlarged or shrunk on request.
class Brush {
 public:
  Brush(Ui& ui, const Rect& square)
      : list_(ui.draw_list()),
        origin_(ui.px(square.x), ui.px(square.y)),
        scale_(ui.px(square.width) / 100) {}

  void fill(const Blob& blob, float grown_by, std::uint32_t colour) {
    std::vector<ImVec2> rim;
    const float radius = blob.radius + grown_by;
    for (const ImVec2& point : blob.points) {
      for (int i = 0; i < kCirclePoints; ++i) {
        const float angle =
            2 * std::numbers::pi_v<float> * static_cast<float>(i) / kCirclePoints;
        rim.emplace_back(origin_.x + scale_ * (point.x + radius * std::cos(angle)),
                         origin_.y + scale_ * (point.y + radius * std::sin(angle)));
      }
    }
    const std::vector<ImVec2> hull = convex_hull(std::move(rim));
    list_.AddConvexPolyFilled(hull.data(), static_cast<int>(hull.size()), colour);
  }

 private:
  ImDrawList& list_;
  ImVec2 origin_;
  float scale_;
};

}  // namespace

const char* words(HandSign sign) noexcept {
  switch (sign) {
    case HandSign::kNone:
      return "";
    case HandSign::kFist:
      return "fist";
    case HandSign::kOneFinger:
      return "one finger";
    case HandSign::kTwoFingers:
      return "two fingers";
    case HandSign::kThreeFingers:
      return "three fingers";
    case HandSign::kReady:
      return "okay, ready";
    case HandSign::kRaise:
      return "thumb up, raise";
    case HandSign::kLower:
      return "thumb down, lower";
    case HandSign::kMatches:
      return "okay, matches";
    case HandSign::kOpenHand:
      return "open hand";
  }
  return "";
}

void draw_hand_sign(Ui& ui, const Rect& place, HandSign sign, Colour ink, Colour ground) {
  if (sign == HandSign::kNone) return;
  ui.note_drawn(std::string("hand sign ") + words(sign));
  const float size = std::min(place.width, place.height);
  Brush brush(ui, place.middle(size, size));
  const Drawing drawing = drawing_of(sign);
  for (const Part& part : drawing.parts) {
    for (const Blob& blob : part) brush.fill(blob, kStroke / 2, ui.rgba(ink));
    for (const Blob& blob : part) brush.fill(blob, -kStroke / 2, ui.rgba(ground));
  }
  for (const Blob& crease : drawing.creases) brush.fill(crease, 0, ui.rgba(ink));
}

}  // namespace jnd::app::gui
