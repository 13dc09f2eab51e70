#include "app/gui/views/bench_picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

using Scene = BenchPicture::Scene;

struct Point {
  float x = 0, y = 0;
};

/// A sheet of 100 by 75 units in the middle of the place; its origin is at the top left.
class Sheet {
 public:
  Sheet(Ui& ui, const Rect& place)
      : ui_(ui),
        scale_(std::min(place.width / 100.0f, place.height / 75.0f)),
        at_{place.x + (place.width - 100.0f * scale_) / 2,
            place.y + (place.height - 75.0f * scale_) / 2} {}

  [[nodiscard]] Point at(Point p) const { return {at_.x + p.x * scale_, at_.y + p.y * scale_}; }
  void line(Point a, Point b, Colour colour, float units = 0.6f) {
    const Point from = at(a), to = at(b);
    ui_.line(from.x, from.y, to.x, to.y, colour, std::max(1.0f, units * scale_));
  }
  void dashed(Point a, Point b, Colour colour) {
    const float length = std::hypot(b.x - a.x, b.y - a.y);
    const int num = std::max(1, static_cast<int>(length / 4.0f));
    for (int i = 0; i < num; ++i) {
      const float from = static_cast<float>(i) / static_cast<float>(num);
      const float to = (static_cast<float>(i) + 0.55f) / static_cast<float>(num);
      line({a.x + from * (b.x - a.x), a.y + from * (b.y - a.y)},
           {a.x + to * (b.x - a.x), a.y + to * (b.y - a.y)}, colour, 0.4f);
    }
  }
  void arrow(Point a, Point b, Colour colour) {
    line(a, b, colour, 0.9f);
    const float length = std::max(0.1f, std::hypot(b.x - a.x, b.y - a.y));
    const Point along = {(b.x - a.x) / length, (b.y - a.y) / length};
    constexpr float kHead = 2.6f;
    for (const float side : {1.0f, -1.0f}) {
      line(b,
           {b.x - kHead * (along.x + side * 0.6f * along.y),
            b.y - kHead * (along.y - side * 0.6f * along.x)},
           colour, 0.9f);
    }
  }
  void dot(Point p, float units, Colour colour) {
    const Point where = at(p);
    ui_.dot(where.x, where.y, units * scale_, colour);
  }
  void ring(Point p, float units, Colour colour, float thickness = 0.5f) {
    const Point where = at(p);
    ui_.ring(where.x, where.y, units * scale_, colour, std::max(1.0f, thickness * scale_));
  }
  void box(Point low, Point high, Colour fill, Colour edge) {
    const Rect place = rect(low, high);
    ui_.fill(place, fill, 2);
    ui_.outline(place, edge, 2, std::max(1.0f, 0.5f * scale_));
  }
  void check(Point p, float units, Colour colour) {
    const Point where = at(p);
    ui_.check(where.x, where.y, units * scale_, colour);
  }
  void words(Point middle, const std::string& text, Colour colour, Font font = Font::kSmall) {
    const Point where = at(middle);
    const float width = ui_.text_width(text, font) + 2, height = ui_.line_height(font);
    ui_.text({where.x - width / 2, where.y - height / 2, width, height}, text,
             {.font = font, .colour = colour, .align = Align::kCentre});
  }
  [[nodiscard]] Rect rect(Point low, Point high) const {
    const Point from = at(low), to = at(high);
    return {from.x, from.y, to.x - from.x, to.y - from.y};
  }

 private:
  Ui& ui_;
  float scale_;
  Point at_;
};

constexpr Point kShoulder{17, 30}, kElbow{44, 17};

void draw_table(Sheet& sheet) { sheet.line({2, 70}, {98, 70}, Colour::kSoft, 0.8f); }

/// Draws the device with its tool at this place.
void draw_device(Sheet& sheet, Point tool) {
  sheet.box({8, 60}, {26, 70}, Colour::kBlueSoft, Colour::kInk);
  sheet.line({17, 60}, kShoulder, Colour::kInk, 1.6f);
  sheet.line(kShoulder, kElbow, Colour::kInk, 1.4f);
  sheet.line(kElbow, tool, Colour::kInk, 1.2f);
  for (const Point joint : {kShoulder, kElbow}) {
    sheet.dot(joint, 2.0f, Colour::kInk);
    sheet.dot(joint, 1.0f, Colour::kCard);
  }
  sheet.dot(tool, 2.4f, Colour::kBlue);
}

void draw_person(Sheet& sheet, Point head) {
  sheet.ring(head, 4.0f, Colour::kInk, 0.9f);
  sheet.line({head.x, head.y + 4}, {head.x, head.y + 20}, Colour::kInk, 0.9f);
  sheet.line({head.x - 5.5f, head.y + 11}, {head.x, head.y + 7}, Colour::kInk, 0.9f);
  sheet.line({head.x + 5.5f, head.y + 11}, {head.x, head.y + 7}, Colour::kInk, 0.9f);
  sheet.line({head.x, head.y + 20}, {head.x - 4.5f, head.y + 31}, Colour::kInk, 0.9f);
  sheet.line({head.x, head.y + 20}, {head.x + 4.5f, head.y + 31}, Colour::kInk, 0.9f);
}

void draw_free_space(Sheet& sheet, Point middle, float radius) {
  constexpr int kDashes = 28;
  for (int i = 0; i < kDashes; ++i) {
    const auto angle = [&](float part) {
      return 2.0f * std::numbers::pi_v<float> * (static_cast<float>(i) + part) / kDashes;
    };
    const auto at = [&](float part) {
      return Point{middle.x + radius * std::cos(angle(part)),
                   middle.y + radius * std::sin(angle(part))};
    };
    sheet.line(at(0.0f), at(0.5f), Colour::kAmber, 0.5f);
  }
}

void draw_weight(Sheet& sheet, Point tool, const std::string& load, bool comes_off) {
  const float top = tool.y + (comes_off ? 20.0f : 11.0f);
  if (!comes_off) sheet.line({tool.x, tool.y + 2.4f}, {tool.x, top - 3}, Colour::kInk, 0.6f);
  sheet.ring({tool.x, top - 1.6f}, 1.6f, Colour::kInk, 0.6f);
  sheet.box({tool.x - 9, top}, {tool.x + 9, top + 13}, Colour::kBlueSoft, Colour::kInk);
  if (!load.empty()) sheet.words({tool.x, top + 6.5f}, load, Colour::kInk, Font::kSmallStrong);
  if (comes_off) {
    sheet.arrow({tool.x + 13, top - 6}, {tool.x + 13, top + 6}, Colour::kAmber);
  } else {
    sheet.arrow({tool.x + 13, top - 1}, {tool.x + 13, top + 12}, Colour::kAmber);
  }
}

/// The box of all marks, seen from above the participant's right shoulder.
class MarkBox {
 public:
  explicit MarkBox(const std::vector<Eigen::Vector3d>& marks_m) {
    low_m_.setConstant(1e9);
    high_m_.setConstant(-1e9);
    for (const Eigen::Vector3d& mark_m : marks_m) {
      low_m_ = low_m_.cwiseMin(mark_m);
      high_m_ = high_m_.cwiseMax(mark_m);
    }
    largest_m_ = std::max((high_m_ - low_m_).maxCoeff(), 1e-6);
  }
  [[nodiscard]] Point operator()(const Eigen::Vector3d& place_m) const {
    const Eigen::Vector3d about = (place_m - 0.5 * (low_m_ + high_m_)) / largest_m_;
    return {70.0f + static_cast<float>(30.0 * about.x() + 15.0 * about.y()),
            42.0f - static_cast<float>(28.0 * about.z() + 12.0 * about.y())};
  }
  /// Draws the box's edges, which join corners that differ along one axis.
  void draw(Sheet& sheet) const {
    const auto corner = [&](int bits) {
      return (*this)({(bits & 1) != 0 ? high_m_.x() : low_m_.x(),
                      (bits & 2) != 0 ? high_m_.y() : low_m_.y(),
                      (bits & 4) != 0 ? high_m_.z() : low_m_.z()});
    };
    for (int bits = 0; bits < 8; ++bits) {
      for (const int side : {1, 2, 4}) {
        if ((bits & side) == 0) sheet.dashed(corner(bits), corner(bits | side), Colour::kSoft);
      }
    }
  }

 private:
  Eigen::Vector3d low_m_, high_m_;
  double largest_m_;
};

void draw_marks(Sheet& sheet, const BenchPicture& picture) {
  draw_table(sheet);
  const MarkBox box(picture.marks_m);
  const bool has_mark =
      picture.mark >= 0 && picture.mark < static_cast<int>(picture.marks_m.size());
  const Point tool =
      has_mark ? box(picture.marks_m[static_cast<std::size_t>(picture.mark)]) : Point{48, 46};
  box.draw(sheet);
  draw_device(sheet, tool);
  for (std::size_t i = 0; i < picture.marks_m.size(); ++i) {
    const Point where = box(picture.marks_m[i]);
    const int place = static_cast<int>(i);
    if (place == picture.mark) {
      sheet.ring(where, 4.6f, Colour::kAmber, 0.9f);
      sheet.dot(where, 2.4f, Colour::kBlue);
    } else if (place < picture.num_touched) {
      sheet.dot(where, 2.6f, Colour::kCard);
      sheet.check(where, 6.0f, Colour::kGreen);
    } else {
      sheet.dot(where, 2.0f, Colour::kCard);
      sheet.ring(where, 1.9f, Colour::kInk, 0.6f);
    }
  }
}

void draw_pushed(Sheet& sheet, int axis) {
  draw_table(sheet);
  constexpr Point kTool{62, 40};
  draw_device(sheet, kTool);
  constexpr Point kAlong[] = {{17, 0}, {9, -9}, {0, -17}};
  const Point along = kAlong[std::clamp(axis, 0, 2)];
  const auto from_tool = [&](float part) {
    return Point{kTool.x + part * along.x, kTool.y + part * along.y};
  };
  sheet.arrow(from_tool(0.25f), from_tool(1.0f), Colour::kAmber);
  sheet.arrow(from_tool(-0.25f), from_tool(-0.8f), Colour::kSoft);
  constexpr float kBeyond[] = {1.45f, 1.6f, 1.3f};
  const Point label = from_tool(kBeyond[std::clamp(axis, 0, 2)]);
  sheet.words({label.x, label.y},
              axis == 0   ? tr("right")
              : axis == 1 ? tr("away")
                          : tr("up"),
              Colour::kInk, Font::kSmallStrong);
}

}  // namespace

void draw_bench_picture(Ui& ui, const Rect& place, const BenchPicture& picture) {
  Sheet sheet(ui, place);
  constexpr Point kResting{62, 54}, kHeld{62, 38}, kHung{62, 28};
  if (picture.scene == Scene::kMarks) return draw_marks(sheet, picture);
  if (picture.scene == Scene::kPushed) return draw_pushed(sheet, picture.axis);
  draw_table(sheet);
  switch (picture.scene) {
    case Scene::kRest:
      sheet.box({52, 57}, {72, 70}, Colour::kBlueSoft, Colour::kInk);
      draw_device(sheet, kResting);
      break;
    case Scene::kHandOut:
      draw_device(sheet, kHeld);
      draw_person(sheet, {88, 38});
      sheet.arrow({67, 38}, {79, 44}, Colour::kAmber);
      break;
    case Scene::kLetGo:
      draw_free_space(sheet, kHeld, 17);
      draw_device(sheet, kHeld);
      draw_person(sheet, {90, 38});
      sheet.arrow({70, 46}, {82, 49}, Colour::kAmber);
      break;
    case Scene::kHang:
    case Scene::kTakeOff:
      draw_device(sheet, kHung);
      draw_weight(sheet, kHung, picture.load, picture.scene == Scene::kTakeOff);
      break;
    case Scene::kMoves:
      draw_free_space(sheet, kHeld, 20);
      draw_device(sheet, kHeld);
      sheet.arrow({66, 38}, {77, 38}, Colour::kAmber);
      sheet.arrow({58, 38}, {47, 38}, Colour::kAmber);
      sheet.arrow({62, 42}, {62, 53}, Colour::kAmber);
      sheet.arrow({62, 34}, {62, 23}, Colour::kAmber);
      draw_person(sheet, {92, 38});
      break;
    case Scene::kMarks:
    case Scene::kPushed:
      break;
  }
}

BenchPicture picture_of_step(const DeviceView& view, std::size_t step) {
  switch (static_cast<CommissioningStep>(step)) {
    case CommissioningStep::kHoming:
    case CommissioningStep::kNoise:
      return {.scene = Scene::kRest};
    case CommissioningStep::kFrame:
      return {.scene = Scene::kMarks, .marks_m = view.marks_m};
    case CommissioningStep::kForce:
      return {.scene = Scene::kHang};
    case CommissioningStep::kDelay:
    case CommissioningStep::kStability:
      break;
  }
  return {.scene = Scene::kMoves};
}

BenchPicture picture_of_question(const std::vector<Eigen::Vector3d>& marks_m,
                                 const DeviceQuestion& question) {
  using Act = DeviceQuestion::Act;
  BenchPicture picture;
  switch (question.act) {
    case Act::kTakeHandOut:
      picture.scene = Scene::kHandOut;
      break;
    case Act::kHome:
    case Act::kHold:
      picture.scene = Scene::kRest;
      break;
    case Act::kLetGo:
      picture.scene = Scene::kLetGo;
      break;
    case Act::kHang:
      picture.scene = Scene::kHang;
      picture.load = tr("{:.0f} g", 1e3 * question.load_kg);
      break;
    case Act::kTakeLoadOff:
      picture.scene = Scene::kTakeOff;
      break;
    case Act::kTouch:
      picture.scene = Scene::kMarks;
      picture.marks_m = marks_m;
      picture.num_touched = question.num_touched;
      for (std::size_t i = 0; i < marks_m.size(); ++i) {
        if (marks_m[i] == question.mark_m) picture.mark = static_cast<int>(i);
      }
      break;
  }
  return picture;
}

std::string place_words(const std::vector<Eigen::Vector3d>& marks_m,
                        const Eigen::Vector3d& mark_m) {
  Eigen::Vector3d middle_m = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& one_m : marks_m) {
    middle_m += one_m / static_cast<double>(marks_m.size());
  }
  const Eigen::Vector3d off_m = mark_m - middle_m;
  std::string words;
  const auto add = [&](double its_m, const char* low, const char* high) {
    if (std::abs(its_m) < 1e-6) return;
    words += (words.empty() ? "" : ", ") + std::string(its_m < 0.0 ? low : high);
  };
  add(off_m.x(), tr("left"), tr("right"));
  add(off_m.y(), tr("near"), tr("far"));
  add(off_m.z(), tr("low"), tr("high"));
  return words;
}

}  // namespace jnd::app::gui
