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
  /// 0 if the laboratory's people cannot be asked about solids.
  double stiffness_weber_fraction = 0.0;
  double criterion_ln = 0.0;
  double criterion_drift_per_trial_ln = 0.0;
  double exponent = 1.0;
  double unit = 1.0;
  double shrink = 1.0;
  double body_height_m = 0.0;
  double hand_height_m = 0.0;  ///< Above the floor.
  bool right_handed = true;
  int age_years = 0;
  double amplitude_score = 0.0;  ///< The person's stroke width, in sd of the population.
  double max_speed_m_per_s = 0.0;
  double rating_steps = 0.0;  ///< How much higher the person rates, in steps of the scale.
  /// The number that this person gives to water when choosing an own modulus.
  double free_modulus = 1.0;
};

/// Draws the person for this session's seed.
[[nodiscard]] Person draw_person(const Laboratory& laboratory, std::uint64_t session_seed);

/// A moment in the session at which something is felt. It is the key of the random numbers, so
/// that a resumed session equals an uninterrupted one.
struct Moment {
  std::int64_t trial = 0;  ///< Running number in the session.
  std::int64_t attempt = 1;
  std::int64_t presentation = 1;
  std::int64_t trial_in_block = 1;  ///< From 1, for learning and fatigue.
};

/// The unit of the numbers in an estimation.
struct Counting {
  /// Number of the standard, or of water if there is no standard.
  double number = 100.0;
  std::optional<double> standard_ln;  ///< How the standard felt; none if it is water.
  bool in_round_numbers = true;       ///< Round numbers as for percent; otherwise two digits.
};

/// Turns felt viscosity into answers, for the same person in every procedure.
///
/// A presentation is read as ln(felt total damping) plus noise of sd ln(1 + w0) / sqrt 2. Felt
/// is the total of rendered force and mechanical viscosity. The person says "thicker" if test
/// minus reference exceeds their criterion, so two total dampings that differ by the factor 1 +
/// w0 are told apart in 84 % of trials. Of two intervals the person chooses the second if it
/// exceeds the first by the criterion, which is then a bias towards an interval. The person
/// calls two stimuli different if they differ by more than ln(1 + w) either way (the
/// differencing rule, Macmillan and Creelman 2005), and says that something is there if it
/// exceeds the remembered free space by as much. That people require one just noticeable
/// difference is an assumption. A magnitude is unit ((felt - free space) / standard)^exponent,
/// clipped at 0 and shrunk in ln towards the magnitude of the range's centre. It gives the
/// answers in estimation and the targets in production. For a solid the same holds for its
/// stiffness, with a separate Weber fraction and nothing felt in free space.
class Perceiver {
 public:
  enum class Feels { kDamping, kStiffness };

  /// Stiffness requires a laboratory with `pressing`.
  Perceiver(const Laboratory& laboratory, const Person& person, std::uint64_t session_seed,
            Feels feels = Feels::kDamping);

  /// Returns the noisy ln of what is felt, a damping in N s/m or a stiffness in N/m; `felt` >
  /// 0.
  [[nodiscard]] double reading_ln(double felt, const Moment& moment) const;
  /// Returns the remembered reading of free space, without noise.
  [[nodiscard]] double free_space_ln() const;

  /// Answers "is the test thicker", from the mean readings of all looks.
  [[nodiscard]] bool says_thicker(double test_ln, double reference_ln,
                                  const Moment& moment) const;

  /// Answers "is anything there". Free space is remembered without noise. The person's
  /// criterion is a bias between two intervals and does not enter.
  [[nodiscard]] bool says_present(double test_ln, double free_space_ln,
                                  const Moment& moment) const;

  /// Answers "do the two differ". The criterion does not enter either.
  [[nodiscard]] bool says_different(double first_ln, double second_ln,
                                    const Moment& moment) const;

  /// Returns percent of water, in the round numbers that people use. `previous_percent` is the
  /// answer before.
  [[nodiscard]] double estimate_percent(double reading_ln, const Moment& moment,
                                        std::optional<double> previous_percent) const;

  /// Returns a number > 0 in another unit. `previous` is the answer before.
  [[nodiscard]] double estimate_number(double reading_ln, const Moment& moment,
                                       std::optional<double> previous,
                                       const Counting& counting) const;

  /// Returns the interval that is chosen of three, from 1, by `chosen_interval` of the task.
  /// The criterion does not enter. A lapse takes any interval that can be chosen.
  [[nodiscard]] int choose_interval(Task task, std::span<const double> readings_ln,
                                    const Moment& moment) const;
  /// Like `certainty_of_thicker`, for such a choice. z is the margin of the choice, scaled to
  /// that of a comparison.
  [[nodiscard]] double certainty_of_choice(Task task, std::span<const double> readings_ln,
                                           int num_looks, const Moment& moment) const;

  /// Returns how certain a person is of an answer: 2 P - 1, where P = Phi(z) is the probability
  /// that it is right, and z is the distance of what was felt from the boundary to another
  /// answer over the standard deviation of its noise (Clarke, Birdsall and Tanner 1959, Galvin
  /// et al. 2003). It goes from 0 for a guess to 1. Each of `num_looks` (>= 1) reduces the
  /// noise of the means. A person who lapses guesses and knows it. Apart from lapses, the
  /// answers are those of `says_thicker`, `says_present` and `says_different`.
  [[nodiscard]] double certainty_of_thicker(double test_ln, double reference_ln, int num_looks,
                                            const Moment& moment) const;
  [[nodiscard]] double certainty_of_present(double test_ln, double free_space_ln, int num_looks,
                                            const Moment& moment) const;
  [[nodiscard]] double certainty_of_different(double first_ln, double second_ln, int num_looks,
                                              const Moment& moment) const;

  /// Returns the answer of a person with this certainty. It is none, "cannot tell", if the
  /// block allows that and the certainty is below the laboratory's `cannot_tell_certainty`. A
  /// person who lapses is certain of nothing. `certainty()` is one of the functions above.
  template <typename Certainty>
  [[nodiscard]] std::optional<double> answer_or_cannot_tell(const Block& block, double answer,
                                                            const Certainty& certainty) const {
    if (!block.cannot_tell) return answer;
    return certainty() < laboratory_.perceiver.cannot_tell_certainty ? std::nullopt
                                                                     : std::optional(answer);
  }

  /// Returns a step from 1 to `num_steps` for a stimulus that feels this far from the weakest
  /// to the strongest one (`magnitude_ratio` of trial_feeling.h). The person's `shrink` pulls
  /// it towards the middle, their `rating_steps` shift it, and the laboratory's assimilation
  /// pulls it towards the step before. A lapse takes any step.
  [[nodiscard]] double rate(double magnitude_ratio, int num_steps, const Moment& moment,
                            std::optional<double> previous_step) const;

  /// Converts a reading to ln of its magnitude, where 0 is the standard's and -infinity means
  /// that nothing is felt. `reading_of_magnitude_ln` is the inverse, and gives the reading of
  /// free space for -infinity.
  [[nodiscard]] double magnitude_of_reading_ln(double reading_ln) const {
    return magnitude_ln(reading_ln);
  }
  [[nodiscard]] double reading_of_magnitude_ln(double magnitude_ln) const;

  enum class Wish { kMatches, kRaiseFine, kRaiseCoarse, kLowerFine, kLowerCoarse };

  /// Returns what the person signals in a production. `first_reading_ln` is the reading of the
  /// starting value.
  [[nodiscard]] Wish wish(double reading_ln, double first_reading_ln, double target_percent,
                          const Moment& moment) const;

  /// Returns what the person signals in a matching, from the mean readings of the comparison
  /// and of the standard. They match if the comparison is neither thicker nor thinner by the
  /// person's criterion.
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
  /// Returns ln of the ratio to what counts as 1, which feels `unit_ln` above water at scale 1.
  [[nodiscard]] std::optional<double> answer_ln(double reading_ln, double unit_ln,
                                                const Moment& moment,
                                                std::optional<double> previous_ratio) const;

  const Laboratory& laboratory_;
  Person person_;
  std::uint64_t seed_;
  double weber_fraction_;
  double free_space_;        ///< What is felt in free space, in the unit of what is felt.
  double threshold_ = 1e-6;  ///< Anything less feels like this.
  double standard_;          ///< What a magnitude of 1 feels like above free space.
};

}  // namespace jnd::experiments
