#pragma once

#include <string>
#include <vector>

#include "analysis/report/figures.h"

namespace jnd::analysis {

/// One participant's movement in one condition, as a figure names it.
struct ShownCondition {
  std::string name;   ///< Of a file's column: "group_d", "viscous_5".
  std::string title;  ///< "Group D", "viscous, 5 Pa s".
  const ConditionMovement* movement = nullptr;
};

/// The whole blocks that this participant moved in, those with strokes; without blocks the
/// media that were explored.
[[nodiscard]] std::vector<ShownCondition> whole_conditions(const FigureSource& source,
                                                           const ParticipantMovement& person);
/// Every intensity apart: of media explored if there are three or more, else of the blocks.
[[nodiscard]] std::vector<ShownCondition> each_intensity(const FigureSource& source,
                                                         const ParticipantMovement& person);

/// Who is shown where the thesis shows one: the first, by pseudonym, with strokes in the most
/// conditions, and with joints if anybody's device had any. Nullptr if nobody has strokes.
[[nodiscard]] const ParticipantMovement* shown_participant(const FigureSource& source,
                                                           const MovementAnalysis& movement);

/// "free space", "viscous, 5 Pa s", "Group D, 1.093 Pa s".
[[nodiscard]] ShownCondition shown_condition(const FigureSource& source,
                                             const ConditionMovement& condition);

/// " A selection: the first 4 of 9 conditions." for a caption; "" if all are shown.
[[nodiscard]] std::string selection_words(std::size_t num_shown, std::size_t num_there,
                                          const std::string& of_what);
/// " (one of 13 with recordings)" after a participant's name; "" if there is one.
[[nodiscard]] std::string person_selection_words(const MovementAnalysis& movement);

/// Of the five fingers, in the order of the contact points.
inline constexpr const char* kFingerTitles[] = {"palm, inner", "palm, outer", "thumb", "index",
                                                "middle"};

/// gnuplot: vertical lines where the hand turns, over a stroke in percent; none where unknown.
[[nodiscard]] std::string turn_lines(const StrokeCurves& curves);

// finger_figures.cpp

/// Joint angles over a stroke (D.18, D.26).
[[nodiscard]] std::optional<Figure> joint_angles_figure(const FigureSource& source,
                                                        const MovementAnalysis& movement,
                                                        const ParticipantMovement& person);
/// Joint torques over the hand's velocity (D.19, D.27).
[[nodiscard]] std::optional<Figure> joint_torques_figure(const FigureSource& source,
                                                         const MovementAnalysis& movement,
                                                         const ParticipantMovement& person);

// tip_distance_figure.cpp

/// Tips' distance to the end effector over a stroke (D.28), of up to five participants.
[[nodiscard]] std::optional<Figure> tip_distances_figure(const FigureSource& source,
                                                         const MovementAnalysis& movement);

}  // namespace jnd::analysis
