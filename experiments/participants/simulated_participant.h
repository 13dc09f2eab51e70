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

/// How a person is about to stroke through one presentation.
struct StrokeIntent {
  double amplitude_m = 0.0;
  double max_speed_m_per_s = 0.0;
  double height_m = 0.0;  ///< Workspace frame: below the surface is negative.
  int num_strokes = 1;    ///< Whole ones, before the person has felt enough.
  double period_s = 0.0;  ///< How long one stroke takes.
  /// Lower by this in mid-stroke forward, higher on the way back; none: as the person tends to.
  std::optional<double> lift_m{};

  /// Until the hand, which trails behind the arm, has visibly turned after the last stroke.
  [[nodiscard]] double turning_s() const noexcept { return 0.2 + 0.1 * period_s; }
  /// All of them, with the turn.
  [[nodiscard]] double duration_s() const noexcept {
    return num_strokes * period_s + turning_s();
  }
};

/// A simulated person in a session: moves, feels, answers. Everything is a function of
/// laboratory, session seed and what was felt in this trial, so a resumed session goes on as it
/// would have.
class SimulatedParticipant {
 public:
  /// The laboratory must outlive the participant.
  SimulatedParticipant(const Laboratory& laboratory, std::uint64_t session_seed);

  [[nodiscard]] const Person& person() const noexcept { return person_; }
  /// In this block: of a solid what is felt is its stiffness, else a damping.
  /// The laboratory's effects of the block's levels are in it.
  [[nodiscard]] Perceiver perceiver(const Block& block,
                                    std::string_view interval = "test") const;
  /// A reading of the standard as one of the test: what feels as strong, where one of them is
  /// pressed and the other is stroked through; else the reading itself.
  [[nodiscard]] double standard_as_test_ln(const Block& block, double standard_ln) const;

  /// Where the hand rests, workspace frame.
  [[nodiscard]] double home_height_m() const;
  /// For a presentation under this procedure; "" outside of any.
  [[nodiscard]] StrokeIntent strokes(const std::string& procedure) const;
  /// The same on a solid whose surface is at this height: the hand hardly moves along it, but
  /// down into it and up again, once a stroke. Throws `Error` where the laboratory has no
  /// numbers for it.
  [[nodiscard]] StrokeIntent presses(const std::string& procedure, double surface_m) const;
  /// To and fro above that surface, from where it is entered by pressing.
  [[nodiscard]] StrokeIntent hover(double surface_m) const;

  /// Answers to questions on paper.
  [[nodiscard]] std::string answer(const QuestionnaireItem& item) const;
  [[nodiscard]] std::string answer(const PostExperimentItem& item) const;
  /// To a question after a trial that was felt so, as the laboratory's `Question` of its name
  /// has it: the share of the way from its least to its greatest answer.
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
