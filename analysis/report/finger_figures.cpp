#include <algorithm>
#include <array>

#include "analysis/report/plot_parts.h"
#include "analysis/report/recording_conditions.h"
#include "analysis/results/number_words.h"
#include "analysis/words/said.h"
#include "core/hand.h"
#include "core/joints.h"

namespace jnd::analysis {
namespace {

constexpr const char* kJointTitles[] = {said_later("base abduction"),
                                        said_later("base extension"), said_later("proximal")};

/// The largest number of rows of panels on a page.
constexpr std::size_t kRows = 4;

std::string joint_column(int finger, int joint) {
  return std::string(
      core::kJointNames[static_cast<std::size_t>(core::finger_joint(finger, joint))]);
}

/// Mean curves of the joints of all fingers, with one block of rows for each condition.
FigureTable joints_table(const std::string& name, const char* unit,
                         const std::vector<ShownCondition>& conditions,
                         const std::array<CurveBand, core::kNumJoints> StrokeCurves::*bands) {
  FigureTable table{
      .name = name,
      .columns = {"series", "condition", "stroke_percent", "forward_velocity_m_per_s"}};
  for (const char* statistic : {"", "_sd"}) {
    for (int joint = core::kNumArmJoints; joint < core::kNumJoints; ++joint) {
      table.columns.push_back(std::string(core::kJointNames[static_cast<std::size_t>(joint)]) +
                              unit + statistic);
    }
  }
  const auto at = [](const std::vector<double>& values, std::size_t i) -> FigureCell {
    return i < values.size() ? FigureCell(values[i]) : FigureCell();
  };
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    const StrokeCurves& curves = conditions[c].movement->curves;
    for (std::size_t i = 0; i < curves.stroke_percent.size(); ++i) {
      std::vector<FigureCell> row = {static_cast<int>(c) + 1, conditions[c].name,
                                     curves.stroke_percent[i],
                                     at(curves.forward_velocity_m_per_s.mean, i)};
      for (const bool spread : {false, true}) {
        for (std::size_t joint = core::kNumArmJoints; joint < core::kNumJoints; ++joint) {
          const CurveBand& band = (curves.*bands)[joint];
          row.push_back(at(spread ? band.standard_deviation : band.mean, i));
        }
      }
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

/// The conditions whose device had joints. `shown` holds as many as fit on a page, and
/// `num_there` is the number of all.
struct JointConditions {
  std::vector<ShownCondition> shown;
  std::size_t num_there = 0;
};
JointConditions with_joints(const FigureSource& source, const ParticipantMovement& person) {
  JointConditions found;
  for (const ShownCondition& condition : whole_conditions(source, person)) {
    if (!condition.movement->curves.has_joints) continue;
    ++found.num_there;
    if (found.shown.size() < kRows) found.shown.push_back(condition);
  }
  return found;
}

/// The title of the condition, beside the first panel of its row.
std::string row_title(int finger, const std::string& title) {
  if (finger > 0) return "  unset ylabel\n";
  return "  set ylabel " + gnuplot_quoted(title) + " font small\n";
}

/// The vertical axis of one finger's panel. It covers the finger's joints with their spread,
/// and has few tics.
std::string own_scale(const std::array<CurveBand, core::kNumJoints>& bands, int finger,
                      bool about_mean, double unit) {
  std::vector<double> values;
  for (int joint = 0; joint < core::kNumJointsPerFinger; ++joint) {
    const CurveBand& band = bands[static_cast<std::size_t>(core::finger_joint(finger, joint))];
    const double middle = about_mean ? mean_of(band.mean) : 0.0;
    for (std::size_t i = 0; i < band.mean.size(); ++i) {
      const bool with_spread = about_mean && i < band.standard_deviation.size();
      const double spread = with_spread ? band.standard_deviation[i] : 0.0;
      values.push_back(unit * (band.mean[i] - middle - spread));
      values.push_back(unit * (band.mean[i] - middle + spread));
    }
  }
  const AxisRange range = axis_range(values);
  return "  set yrange " + range_words(range) + "\n" + small_tics("y", range);
}

constexpr char kKeyAbove[] =
    "  set key at screen 0.5,0.995 center top vertical maxrows 1 reverse Left samplen 2 font "
    "small\n";

std::string who_words(const MovementAnalysis& movement, const ParticipantMovement& person,
                      const std::vector<ShownCondition>& conditions, std::size_t num_there) {
  std::string words =
      said("Participant {}{}; rows:", person.participant, person_selection_words(movement));
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    words += (i > 0 ? ", " : " ") + conditions[i].title + " (" +
             counted_words(conditions[i].movement->curves.num_strokes, "stroke") + ")";
  }
  return said(
      "{}.{} Columns: the five fingers of the exoskeleton, by where they hold the hand. ",
      words, selection_words(conditions.size(), num_there, said("conditions with strokes")));
}

}  // namespace

std::optional<Figure> joint_angles_figure(const FigureSource& source,
                                          const MovementAnalysis& movement,
                                          const ParticipantMovement& person) {
  const auto [conditions, num_there] = with_joints(source, person);
  if (conditions.empty()) return std::nullopt;
  FigureTable table =
      joints_table("joint_angles", "_rad", conditions, &StrokeCurves::joint_position_rad);
  Figure figure{.name = "joint_angles",
                .section = "movement",
                .title = said("Joint angles over a stroke"),
                .thesis = said("Fig. D.18 and D.26")};
  PanelGrid grid{.num_columns = core::kNumContactPoints,
                 .x_title = said("Stroke [%]"),
                 .y_title = said("Change of the joint angle [°]"),
                 .left_in = 0.95,
                 .top_in = 0.55};
  std::vector<Panel> panels;
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    for (int finger = 0; finger < core::kNumContactPoints; ++finger) {
      Panel panel{.title = c == 0 ? said(kFingerTitles[finger]) : ""};
      if (panels.empty()) {
        panel.before =
            std::string(kKeyAbove) + "  set xrange [0:100]\n  set xtics 50 font small\n";
      }
      panel.before += row_title(finger, conditions[c].title) +
                      own_scale(conditions[c].movement->curves.joint_position_rad, finger,
                                /*about_mean=*/true, 57.29577951308232);
      if (finger == 0) panel.before += turn_lines(conditions[c].movement->curves);
      panel.plot = "plot ";
      for (int joint = 0; joint < core::kNumJointsPerFinger; ++joint) {
        const std::string column = joint_column(finger, joint) + "_rad";
        const std::string here = "(column('series')==" + std::to_string(c + 1) + " ? ";
        const std::string type = std::to_string(joint + 1);
        // Angles are relative to their mean over the stroke, because the range of the motion is
        // compared.
        const auto index = static_cast<std::size_t>(core::finger_joint(finger, joint));
        const std::string mean =
            plot_number(mean_of(conditions[c].movement->curves.joint_position_rad[index].mean));
        const std::string degrees = "*57.29577951308232 : NaN)";
        panel.plot += (joint > 0 ? ", " : "") + from_table(table) + "'stroke_percent':" + here +
                      "(column('" + column + "')-" + mean + "-column('" + column + "_sd'))" +
                      degrees + ":" + here + "(column('" + column + "')-" + mean + "+column('" +
                      column + "_sd'))" + degrees + " with filledcurves lt " + type +
                      " fs transparent solid 0.18 noborder, " + from_table(table) +
                      "'stroke_percent':" + here + "(column('" + column + "')-" + mean + ")" +
                      degrees + " with lines lt " + type + " lw 1.5";
        if (panels.empty()) panel.plot += " title " + gnuplot_quoted(said(kJointTitles[joint]));
      }
      panels.push_back(std::move(panel));
    }
  }
  figure.height_in = grid_height_in(grid, panels.size(), 1.25);
  figure.plot = grid_plot(grid, panels, figure.width_in, figure.height_in);
  figure.caption = said(
      "{}Mean and standard deviation over strokes, each joint about its mean over the stroke; "
      "the distal joint follows the proximal one. 0 % is the middle of the motion back, dashed "
      "lines are the turning points.",
      who_words(movement, person, conditions, num_there));
  figure.tables = {std::move(table)};
  return figure;
}

std::optional<Figure> joint_torques_figure(const FigureSource& source,
                                           const MovementAnalysis& movement,
                                           const ParticipantMovement& person) {
  const auto [conditions, num_there] = with_joints(source, person);
  if (conditions.empty()) return std::nullopt;
  FigureTable table =
      joints_table("joint_torques", "_n_m", conditions, &StrokeCurves::joint_torque_n_m);
  Figure figure{.name = "joint_torques",
                .section = "movement",
                .title = said("Joint torques over the velocity of the hand"),
                .thesis = said("Fig. D.19 and D.27")};
  PanelGrid grid{.num_columns = core::kNumContactPoints,
                 .x_title = said("Velocity of the hand, forward positive [m/s]"),
                 .y_title = said("Joint torque [N m]"),
                 .left_in = 1.05,
                 .top_in = 0.55};
  std::vector<Panel> panels;
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    for (int finger = 0; finger < core::kNumContactPoints; ++finger) {
      Panel panel{.title = c == 0 ? said(kFingerTitles[finger]) : ""};
      if (panels.empty()) {
        panel.before = std::string(kKeyAbove) + "  set xtics 0.5 font small\n";
      }
      panel.before += row_title(finger, conditions[c].title) +
                      own_scale(conditions[c].movement->curves.joint_torque_n_m, finger,
                                /*about_mean=*/false, 1.0);
      panel.plot = "plot ";
      for (int joint = 0; joint < core::kNumJointsPerFinger; ++joint) {
        const std::string column = joint_column(finger, joint) + "_n_m";
        const std::string type = std::to_string(joint + 1);
        panel.plot +=
            (joint > 0 ? ", " : "") + from_table(table) +
            "'forward_velocity_m_per_s':" + if_series(static_cast<int>(c) + 1, column) +
            " with lines lt " + type + " lw 1.3";
        if (panels.empty()) panel.plot += " title " + gnuplot_quoted(said(kJointTitles[joint]));
        panel.plot += ", " + from_table(table) +
                      "(column('stroke_percent')==0 ? column('forward_velocity_m_per_s') : "
                      "NaN):" +
                      if_series(static_cast<int>(c) + 1, column) +
                      " with points pt 7 ps 0.4 lc rgb 'black'";
      }
      panels.push_back(std::move(panel));
    }
  }
  figure.height_in = grid_height_in(grid, panels.size(), 1.25);
  figure.plot = grid_plot(grid, panels, figure.width_in, figure.height_in);
  figure.caption = said(
      "{}Means over strokes, as the torque sensors say; black dots: the middle of the motion "
      "back, where a stroke begins.",
      who_words(movement, person, conditions, num_there));
  figure.tables = {std::move(table)};
  return figure;
}

}  // namespace jnd::analysis
