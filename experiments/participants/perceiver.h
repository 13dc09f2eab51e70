#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "experiments/participants/laboratory.h"
#include "experiments/procedures/task.h"

namespace jnd::experiments {

/// One simulated person, drawn from a laboratory's population.
struct Person {
  double weber_fraction = 0.0;
  double stiffness_weber_fraction = 0.0;  ///< 0 where nobody is asked about solids.
  double criterion_ln = 0.0;
  double criterion_drift_per_trial_ln = 0.0;
  double exponent = 1.0;
  double unit = 1.0;
  double shrink = 1.0;
  double body_height_m = 0.0;
  double hand_height_m = 0.0;  ///< Above the floor.
  bool right_handed = true;
  int age_years = 0;
  double amplitude_score = 0.0;  ///< Own stroke width, in sd of the population.
  double max_speed_m_per_s = 0.0;
  double rating_steps = 0.0;  ///< By how much ratings are higher, in steps of the scale.
  double free_modulus = 1.0;  ///< The number that water gets from who chooses their own.
};

/// The person that this session's seed stands for.
[[nodiscard]] Person draw_person(const Laboratory& laboratory, std::uint64_t session_seed);

/// Where in the session something is felt: keys the random numbers, so that a resumed session
/// equals an uninterrupted one.
struct Moment {
  std::int64_t trial = 0;  ///< Running number in the session.
  std::int64_t attempt = 1;
  std::int64_t presentation = 1;
  std::int64_t trial_in_block = 1;  ///< From 1, for learning and fatigue.
};

/// What the numbers of an estimation count in.
struct Counting {
  double number = 100.0;              ///< Of the standard, or of water where there is none.
  std::optional<double> standard_ln;  ///< How the standard felt; none where it is water.
  bool in_round_numbers = true;       ///< Of the hundred; else to two digits.
};

/// From felt viscosity to answers, the same person in every procedure.
///
/// A presentation is read as ln(felt total damping) with noise of sd ln(1 + w0) / sqrt 2; felt
/// is what the hand was put through: rendered force and mechanical viscosity. "Thicker" is said
/// where test minus reference exceeds the person's criterion, so that two total dampings that
/// differ by the factor 1 + w0 are told apart with 84 %. Of two intervals the second is chosen
/// where it exceeds the first by the criterion, which is then a bias for an interval. Two are
/// called different where they differ by more than ln(1 + w) either way (the
/// differencing rule, Macmillan and Creelman 2005), and something is said to be there where it
/// exceeds what is remembered of free space by as much: that people ask for one just noticeable
/// difference is an assumption. A magnitude is
///     unit ((felt - free space) / standard)^exponent,  clipped at 0,
/// shrunk in ln toward that of the range's centre: answers in estimation, targets in
/// production. Of a solid the same holds for its stiffness, with a Weber fraction of its own
/// and nothing felt in free space.
class Perceiver {
 public:
  enum class Feels { kDamping, kStiffness };

  /// Stiffness takes a laboratory with `pressing`.
  Perceiver(const Laboratory& laboratory, const Person& person, std::uint64_t session_seed,
            Feels feels = Feels::kDamping);

  /// Noisy ln of what is felt, a damping in N s/m or a stiffness in N/m; `felt` > 0.
  [[nodiscard]] double reading_ln(double felt, const Moment& moment) const;
  /// What free space is remembered to feel like, as its reading without noise.
  [[nodiscard]] double free_space_ln() const;

  /// Answer to "is the test thicker", from the mean readings of all looks.
  [[nodiscard]] bool says_thicker(double test_ln, double reference_ln,
                                  const Moment& moment) const;

  /// Answer to "is anything there"; free space is remembered without noise. The person's
  /// criterion is an error between two intervals and has no part in it.
  [[nodiscard]] bool says_present(double test_ln, double free_space_ln,
                                  const Moment& moment) const;

  /// Answer to "do the two differ"; the criterion has no part in it either.
  [[nodiscard]] bool says_different(double first_ln, double second_ln,
                                    const Moment& moment) const;

  /// Percent of water, in the round numbers people use. `previous_percent` is the answer
  /// before.
  [[nodiscard]] double estimate_percent(double reading_ln, const Moment& moment,
                                        std::optional<double> previous_percent) const;

  /// A number > 0 in another count. `previous` is the answer before.
  [[nodiscard]] double estimate_number(double reading_ln, const Moment& moment,
                                       std::optional<double> previous,
                                       const Counting& counting) const;

  /// The interval that is chosen of three, from 1, by `chosen_interval` of the task; the
  /// criterion has no part in it. Who lapses takes any that can be chosen.
  [[nodiscard]] int choose_interval(Task task, std::span<const double> readings_ln,
                                    const Moment& moment) const;
  /// As `certainty_of_thicker`, of such a choice: z is its margin over that of a comparison.
  [[nodiscard]] double certainty_of_choice(Task task, std::span<const double> readings_ln,
                                           int num_looks, const Moment& moment) const;

  /// How sure somebody is of an answer: 2 P - 1 of the probability P = Phi(z) that it is right,
  /// z being how far what was felt lies from where another answer begins, over the standard
  /// deviation of its noise (Clarke, Birdsall and Tanner 1959, Galvin et al. 2003). From 0 of a
  /// guess to 1. Each of `num_looks` (>= 1) makes the noise of the means smaller; who lapses
  /// guesses, and knows it. A lapse apart, the answers are those of `says_thicker`,
  /// `says_present` and `says_different`.
  [[nodiscard]] double certainty_of_thicker(double test_ln, double reference_ln, int num_looks,
                                            const Moment& moment) const;
  [[nodiscard]] double certainty_of_present(double test_ln, double free_space_ln, int num_looks,
                                            const Moment& moment) const;
  [[nodiscard]] double certainty_of_different(double first_ln, double second_ln, int num_looks,
                                              const Moment& moment) const;

  /// The answer of somebody who is so certain of it; none, "cannot tell", where the block takes
  /// that and they are less certain than the laboratory's `cannot_tell_certainty`. Who lapses
  /// is certain of nothing. `certainty()` is one of those above.
  template <typename Certainty>
  [[nodiscard]] std::optional<double> answer_or_cannot_tell(const Block& block, double answer,
                                                            const Certainty& certainty) const {
    if (!block.cannot_tell) return answer;
    return certainty() < laboratory_.perceiver.cannot_tell_certainty ? std::nullopt
                                                                     : std::optional(answer);
  }

  /// A step from 1 to `num_steps` for a stimulus that is felt this part of the way from the
  /// weakest to the strongest one (`magnitude_ratio` of trial_feeling.h), drawn toward the
  /// middle by the person's `shrink`, moved by their `rating_steps`, and drawn by the
  /// laboratory's assimilation toward the step before. Who lapses takes any step.
  [[nodiscard]] double rate(double magnitude_ratio, int num_steps, const Moment& moment,
                            std::optional<double> previous_step) const;

  /// ln of the magnitude that such a reading feels like, 0 being the standard's; -infinity
  /// where nothing is felt. And back, to the reading of free space.
  [[nodiscard]] double magnitude_of_reading_ln(double reading_ln) const {
    return magnitude_ln(reading_ln);
  }
  [[nodiscard]] double reading_of_magnitude_ln(double magnitude_ln) const;

  enum class Wish { kMatches, kRaiseFine, kRaiseCoarse, kLowerFine, kLowerCoarse };

  /// What the person signals in production. `first_reading_ln` is that of the starting value.
  [[nodiscard]] Wish wish(double reading_ln, double first_reading_ln, double target_percent,
                          const Moment& moment) const;

  /// What the person signals in a matching, from the mean readings of the comparison and of the
  /// standard: what is neither thicker nor thinner by their criterion matches.
  [[nodiscard]] Wish wish_to_match(double reading_ln, double first_reading_ln,
                                   double standard_ln, const Moment& moment) const;

  [[nodiscard]] bool looks_again(const Moment& moment) const;

 private:
  [[nodiscard]] double certainty(double distance_ln, double noise_sd_ln, int num_looks,
                                 const Moment& moment) const;
  [[nodiscard]] Wish step_for(double difference_ln) const;
  [[nodiscard]] double criterion_ln(const Moment& moment) const;
  [[nodiscard]] double magnitude_ln(double reading_ln) const;
  [[nodiscard]] double centre_ln() const;
  [[nodiscard]] bool lapses(const Moment& moment) const;
  [[nodiscard]] bool guesses_yes(const Moment& moment) const;
  /// ln of the ratio to what counts as 1, which is felt `unit_ln` above water at scale 1.
  [[nodiscard]] std::optional<double> answer_ln(double reading_ln, double unit_ln,
                                                const Moment& moment,
                                                std::optional<double> previous_ratio) const;

  const Laboratory& laboratory_;
  Person person_;
  std::uint64_t seed_;
  double weber_fraction_;
  double free_space_;        ///< What is felt there, in the unit of what is felt.
  double threshold_ = 1e-6;  ///< Anything less feels like it.
  double standard_;          ///< What a magnitude of 1 is over free space.
};

}  // namespace jnd::experiments
