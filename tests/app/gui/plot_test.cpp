#include "app/gui/plot.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <cmath>
#include <limits>

#include "app/gui/headless_ui.h"

namespace jnd::app::gui {
namespace plot_test {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr Rect kPlace = {100, 100, 500, 300};

PlotModel line_of(int count) {
  PlotModel model = {.title = "Speed of the hand", .unit = "m/s"};
  model.x.label = "time";
  PlotSeries line;
  for (int i = 0; i < count; ++i) {
    line.x.push_back(0.01 * i);
    line.y.push_back(std::sin(0.4 * i));
  }
  model.series.push_back(line);
  return model;
}

int num_vertices(HeadlessUi& ui, const PlotModel& model) {
  int count = 0;
  ui.frame([&](Ui& frame) {
    const int before = frame.draw_list().VtxBuffer.Size;
    draw_plot(frame, kPlace, model);
    count = frame.draw_list().VtxBuffer.Size - before;
  });
  return count;
}

TEST(Plot, PutsValuesWhereTheAxesSay) {
  HeadlessUi ui;
  PlotModel model = line_of(10);
  model.x = {.minimum = 0.0, .maximum = 10.0};
  model.y = {.minimum = -1.0, .maximum = 1.0};
  PlotArea area;
  ui.frame([&](Ui& frame) { area = draw_plot(frame, kPlace, model); });
  EXPECT_FLOAT_EQ(area.x(0), area.place.x);
  EXPECT_FLOAT_EQ(area.x(5), area.place.x + area.place.width / 2);
  EXPECT_FLOAT_EQ(area.y(-1), area.place.bottom());
  EXPECT_FLOAT_EQ(area.y(1), area.place.y);
  EXPECT_GE(area.place.x, kPlace.x);
  EXPECT_LE(area.place.right(), kPlace.right());
  EXPECT_LE(area.place.bottom(), kPlace.bottom());
}

TEST(Plot, ALogarithmicAxisPutsTheGeometricMeanInTheMiddle) {
  HeadlessUi ui;
  PlotModel model = line_of(10);
  model.x = {.logarithmic = true, .minimum = 1.0, .maximum = 100.0};
  PlotArea area;
  ui.frame([&](Ui& frame) { area = draw_plot(frame, kPlace, model); });
  EXPECT_NEAR(area.x(10), area.place.x + area.place.width / 2, 1e-3);
  EXPECT_FALSE(area.can_show(0, 1));
  EXPECT_FALSE(area.can_show(-1, 1));
}

TEST(Plot, EqualScalesMakeAMetreAsLongBothWays) {
  HeadlessUi ui;
  PlotModel model = {.equal_scales = true, .axes = false};
  model.series.push_back({.x = {0, 0.6}, .y = {0, 0.1}});
  PlotArea area;
  ui.frame([&](Ui& frame) { area = draw_plot(frame, kPlace, model); });
  EXPECT_NEAR(area.x(0.5) - area.x(0.4), area.y(0.4) - area.y(0.5), 1e-2);
}

TEST(Plot, ShowsTitleUnitTicksLabelsAndALegendWhereThereIsMoreThanOneSeries) {
  HeadlessUi ui;
  PlotModel model = line_of(100);
  model.x = {.label = "test viscosity", .unit = "Pa s", .minimum = -10.0, .maximum = 0.0};
  model.x.tick_suffix = " s";
  model.series[0].name = "estimation";
  model.marks.push_back({.at = -3, .label = "p (1 + w)"});
  const auto draw = [&](Ui& frame) { draw_plot(frame, kPlace, model); };
  ui.frame(draw);
  for (const char* text :
       {"Speed of the hand", "m/s", "test viscosity · Pa s", "−10 s", "0 s", "p (1 + w)"}) {
    EXPECT_TRUE(ui.drawn().shows(text)) << text;
  }
  EXPECT_FALSE(ui.drawn().shows("estimation"));
  model.series.push_back(model.series[0]);
  model.series[1].name = "production";
  ui.frame(draw);
  EXPECT_TRUE(ui.drawn().shows("estimation"));
  EXPECT_TRUE(ui.drawn().shows("production"));
}

TEST(Plot, LeavesOutWhatIsNotFiniteAndIsNotWidenedByIt) {
  HeadlessUi ui;
  PlotModel model;
  const double inf = std::numeric_limits<double>::infinity();
  model.series.push_back({.x = {0, 1, 2, kNan, 4}, .y = {1, kNan, 3, 2, inf}});
  model.series.push_back({.style = PlotSeries::Style::kPoints,
                          .x = {0, kNan, 2},
                          .y = {kNan, 1, 2},
                          .low = {0, 0, kNan},
                          .high = {1, inf, 3}});
  model.series.push_back({.style = PlotSeries::Style::kBand,
                          .x = {0, 1, 2},
                          .low = {0, kNan, 1},
                          .high = {1, 2, inf}});
  model.boxes.push_back({.x = kNan, .median = kNan});
  model.marks.push_back({.at = kNan, .label = "nowhere"});
  PlotArea area;
  ui.frame([&](Ui& frame) {
    area = draw_plot(frame, kPlace, model);
    for (const ImDrawVert& vertex : frame.draw_list().VtxBuffer) {
      ASSERT_TRUE(std::isfinite(vertex.pos.x) && std::isfinite(vertex.pos.y));
    }
  });
  EXPECT_LT(area.y_range.high, 10);
  EXPECT_FALSE(ui.drawn().shows("nowhere"));
}

TEST(Plot, NothingAtAllIsDrawnAsAxes) {
  HeadlessUi ui;
  for (const bool logarithmic : {false, true}) {
    PlotModel model;
    model.x.logarithmic = model.y.logarithmic = logarithmic;
    ui.frame([&](Ui& frame) {
      draw_plot(frame, kPlace, model);
      draw_plot(frame, {0, 0, 3, 2}, model);
      draw_plot(frame, {0, 0, -5, -5}, model);
    });
    EXPECT_TRUE(ui.drawn().shows("1"));
  }
}

TEST(Plot, TenThousandPointsCostNoMoreThanWhatCanBeSeenOfThem) {
  HeadlessUi ui;
  const int few = num_vertices(ui, line_of(500));
  const int many = num_vertices(ui, line_of(100000));
  EXPECT_LT(many, 12 * few);
  EXPECT_LT(many, 4 * 500 * 8) << "at most four points a column";
}

TEST(Plot, ThinningKeepsASinglePeak) {
  HeadlessUi ui;
  PlotModel model = {.axes = false};
  PlotSeries line;
  for (int i = 0; i < 50000; ++i) {
    line.x.push_back(i);
    line.y.push_back(i == 31234 ? 1.0 : 0.0);
  }
  model.series.push_back(line);
  ui.frame([&](Ui& frame) {
    const int before = frame.draw_list().VtxBuffer.Size;
    const PlotArea area = draw_plot(frame, kPlace, model);
    float top = 1e6f;
    for (int i = before; i < frame.draw_list().VtxBuffer.Size; ++i) {
      top = std::min(top, frame.draw_list().VtxBuffer[i].pos.y);
    }
    EXPECT_NEAR(top, area.y(1.0), 4);
  });
}

TEST(Plot, SaysTheValueUnderTheMouseAndNothingElsewhere) {
  HeadlessUi ui;
  PlotModel model;
  model.x = {.label = "viscosity", .unit = "Pa s", .minimum = 0.0, .maximum = 2.0};
  model.y = {.unit = "%", .minimum = 0.0, .maximum = 100.0};
  model.series.push_back({.style = PlotSeries::Style::kPoints,
                          .x = {0.5, 1.65},
                          .y = {20, 75},
                          .names = {"P01", "P02"}});
  model.boxes.push_back({.x = 1,
                         .lower_whisker = 30,
                         .lower_quartile = 40,
                         .median = 50,
                         .upper_quartile = 60,
                         .upper_whisker = 70,
                         .name = "Group D"});
  PlotArea area;
  const auto draw = [&](Ui& frame) { area = draw_plot(frame, kPlace, model); };
  ui.frame(draw);
  EXPECT_FALSE(ui.drawn().shows("P02"));
  ui.move(area.x(1.65) + 3, area.y(75) - 3);
  ui.frame(draw);
  EXPECT_TRUE(ui.drawn().shows("P02:  75.0 % at 1.65 Pa s"));
  EXPECT_FALSE(ui.drawn().shows("P01"));
  ui.move(area.x(1), area.y(50));
  ui.frame(draw);
  EXPECT_TRUE(ui.drawn().shows("Group D:  median 50.0 %"));
  ui.move(area.x(1.65), area.y(20));
  ui.frame(draw);
  EXPECT_FALSE(ui.drawn().shows("at "));
}

TEST(Plot, AMeasuredPointIsMeantRatherThanTheCurveBesideIt) {
  HeadlessUi ui;
  PlotModel model;
  model.x = {.minimum = 0.0, .maximum = 10.0};
  model.y = {.minimum = 0.0, .maximum = 10.0};
  PlotSeries curve = {.name = "fit"};
  for (int i = 0; i <= 1000; ++i) {
    curve.x.push_back(0.01 * i);
    curve.y.push_back(0.01 * i);
  }
  model.series = {
      curve, {.style = PlotSeries::Style::kPoints, .name = "answers", .x = {5}, .y = {5.1}}};
  PlotArea area;
  const auto draw = [&](Ui& frame) { area = draw_plot(frame, kPlace, model); };
  ui.frame(draw);
  ui.move(area.x(5) + 6, area.y(5.1) + 2);
  ui.frame(draw);
  EXPECT_TRUE(ui.drawn().shows("answers:"));
  ui.move(area.x(5) + 60, area.y(5) - 40);
  ui.frame(draw);
  EXPECT_FALSE(ui.drawn().shows("answers:"));
}

TEST(Plot, BelowADialogItSaysNothing) {
  HeadlessUi ui;
  PlotModel model = line_of(10);
  PlotArea area;
  const auto draw = [&](Ui& frame) {
    area = draw_plot(frame, kPlace, model);
    frame.begin_dialog("note", 300, 200);
    frame.end_dialog();
  };
  ui.frame(draw);
  ui.move(area.x(0), area.y(0));
  ui.frame(draw);
  EXPECT_FALSE(ui.drawn().shows(" at "));
}

}  // namespace plot_test
}  // namespace jnd::app::gui
