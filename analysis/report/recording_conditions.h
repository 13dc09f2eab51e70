#pragma once

#include <string>
#include <vector>

#include "analysis/report/figures.h"

namespace jnd::analysis {

/// One participant's movement in one condition, with its names in a figure.
struct ShownCondition {
  std::string name;   ///< The name in a column of a file, such as "group_d" or "viscous_5".
  std::string title;  ///< For example "Group D" or "viscous, 5 Pa s".
  const ConditionMovement* movement = nullptr;
};

/// The whole blocks in which this participant made strokes. If there are no blocks, the media
/// that were explored.
[[nodiscard]] std::vector<ShownCondition> whole_conditions(const FigureSource& source,
                                                           const ParticipantMovement& person);
/// Every intensity separately: of the explored media if there are at least three, and of the
/// blocks otherwise.
[[nodiscard]] std::vector<ShownCondition> each_intensity(const FigureSource& source,
                                                         const ParticipantMovement& person);

/// The participant who is shown where the thesis shows one: the first by pseudonym among those
/// with strokes in the most conditions, and with joints if anybody's device had joints. nullptr
/// if nobody has strokes.
[[nodiscard]] const ParticipantMovement* shown_participant(const FigureSource& source,
                                                           const MovementAnalysis& movement);

/// The titles are like "free space", "viscous, 5 Pa s" or "Group D, 1.093 Pa s".
[[nodiscard]] ShownCondition shown_condition(const FigureSource& source,
                                             const ConditionMovement& condition);

/// A sentence for a caption, such as " A selection: the first 4 of 9 conditions."; "" if all
/// are shown.
[[nodiscard]] std::string selection_words(std::size_t num_shown, std::size_t num_there,
                                          const std::string& of_what);
/// Words after a participant's name, such as " (one of 13 with recordings)"; "" if there is
/// only one.
[[nodiscard]] std::string person_selection_words(const MovementAnalysis& movement);

/// The names of the five contact points, in their order.
inline constexpr const char* kFingerTitles[] = {"palm, inner", "palm, outer", "thumb", "index",
                                                "middle"};

/// gnuplot commands for vertical lines where the hand turns, in percent of a stroke. Unknown
/// turning points have no line.
[[nodiscard]] std::string turn_lines(const StrokeCurves& curves);

// Defined in finger_figures.cpp:

/// Joint angles over a stroke (D.18, D.26).
[[nodiscard]] std::optional<Figure> joint_angles_figure(const FigureSource& source,
                                                        const MovementAnalysis& movement,
                                                        const ParticipantMovement& person);
/// Joint torques over the hand's velocity (D.19, D.27).
[[nodiscard]] std::optional<Figure> joint_torques_figure(const FigureSource& source,
                                                         const MovementAnalysis& movement,
                                                         const ParticipantMovement& person);

// Defined in tip_distance_figure.cpp:

/// The tips' distance from the end effector over a stroke (D.28), for up to five participants.
[[nodiscard]] std::optional<Figure> tip_distances_figure(const FigureSource& source,
                                                         const MovementAnalysis& movement);

}  // namespace jnd::analysis
