#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/participants/perceiver.h"
#include "experiments/participants/trial_feeling.h"
#include "experiments/study/study.h"

namespace jnd::experiments {

/// How a person will stroke in one presentation.
struct StrokeIntent {
  double amplitude_m = 0.0;
  double max_speed_m_per_s = 0.0;
  double height_m = 0.0;  ///< In the workspace frame; below the surface is negative.
  int num_strokes = 1;    ///< Whole strokes until the person has felt enough.
  double period_s = 0.0;  ///< Duration of one stroke.
  /// The hand is lower by this in the middle of a stroke forward, and higher on the way back.
  /// None means the person's own habit.
  std::optional<double> lift_m{};

  /// Returns the time until the hand, which trails behind the arm, has visibly turned after the
  /// last stroke.
  [[nodiscard]] double turning_s() const noexcept { return 0.2 + 0.1 * period_s; }
  /// Returns the duration of all strokes, with the turn.
  [[nodiscard]] double duration_s() const noexcept {
    return num_strokes * period_s + turning_s();
  }
};

/// A simulated person in a session, who moves, feels and answers. Everything is a function of
/// the laboratory, the session seed and what was felt in this trial, so a resumed session
/// continues as it would have.
class SimulatedParticipant {
 public:
  /// The laboratory must outlive the participant.
  SimulatedParticipant(const Laboratory& laboratory, std::uint64_t session_seed);

  [[nodiscard]] const Person& person() const noexcept { return person_; }
  /// Returns the perceiver for this block, which feels the stiffness of a solid and otherwise a
  /// damping. It contains the laboratory's effects of the block's levels.
  [[nodiscard]] Perceiver perceiver(const Block& block,
                                    std::string_view interval = "test") const;
  /// Converts a reading of the standard to an equally strong one of the test, if one of them is
  /// pressed and the other is stroked through. Otherwise returns the reading itself.
  [[nodiscard]] double standard_as_test_ln(const Block& block, double standard_ln) const;

  /// Returns where the hand rests, in the workspace frame.
  [[nodiscard]] double home_height_m() const;
  /// Returns the strokes of a presentation in this procedure; "" is for outside of any.
  [[nodiscard]] StrokeIntent strokes(const std::string& procedure) const;
  /// Returns the presses of a solid whose surface is at this height. Each stroke goes down into
  /// it and up again, with little movement along it. Throws `Error` if the laboratory has no
  /// numbers for pressing.
  [[nodiscard]] StrokeIntent presses(const std::string& procedure, double surface_m) const;
  /// Returns strokes to and fro above that surface, from which a press begins.
  [[nodiscard]] StrokeIntent hover(double surface_m) const;

  /// Answers questions of questionnaires.
  [[nodiscard]] std::string answer(const QuestionnaireItem& item) const;
  [[nodiscard]] std::string answer(const PostExperimentItem& item) const;
  /// Answers a question after a trial that felt like this, by the laboratory's `Question` of
  /// that name: the share of the way from the question's least to its greatest answer.
  [[nodiscard]] std::string answer(const QuestionnaireItem& item,
                                   const TrialFeeling& feeling) const;

 private:
  const Laboratory& laboratory_;
  std::uint64_t seed_;
  Person person_;
  Perceiver perceiver_;
  std::optional<Perceiver> pressing_perceiver_;
};

}  // namespace jnd::experiments
