#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/study/design.h"

namespace jnd::experiments {

/// A simulated laboratory, read from a file: an apparatus with its imperfections, and a
/// population of participants. Every number has a basis: "thesis", "calibrated" or
/// "assumption".
struct Laboratory {
  /// The lumped hand.
  struct Device {
    /// Mass of hand, fingers and arm as felt, > 0.
    double mass_kg = 0.0;
    double mechanical_viscosity_n_s_per_m = 0.0;  ///< What free space feels like, >= 0.
    double dry_friction_n = 0.0;                  ///< >= 0.
    double max_force_per_point_n = 0.0;           ///< Limit of the force limiter, > 0.
    double max_total_force_n = 0.0;               ///< Limit of the force limiter, > 0.
    double max_slew_n_per_s = 0.0;                ///< Limit of the force limiter, > 0.
  };

  /// A normal or log-normal distribution over persons.
  struct Spread {
    double mean = 0.0;
    double sd = 0.0;  ///< In ln if the mean is a ratio or size; each use says so.
  };

  struct Arm {
    double stiffness_n_per_m = 0.0;  ///< >= 0.
    double damping_n_s_per_m = 0.0;  ///< >= 0.
    double home_s = 0.0;             ///< Time to come to rest between trials, > 0.
  };

  /// How persons stroke in one procedure. Spreads between persons are in ln.
  struct Strokes {
    double amplitude_m = 0.0, amplitude_sd_ln = 0.0;
    int strokes_per_presentation = 1;  ///< Full cycles, >= 1.
  };
  /// What all strokes have in common.
  struct Movement {
    double max_speed_m_per_s = 0.0,
           max_speed_sd_ln = 0.0;  ///< Largest speed of the reference, and its spread.
    /// Variation within a person.
    double stroke_amplitude_sd_ratio = 0.0, stroke_speed_sd_ratio = 0.0;
    double stroke_height_sd_m = 0.0;
    /// The hand is lower by this on the way forward and higher on the way back.
    double lift_m = 0.0;
    double body_height_m = 0.0, body_height_sd_m = 0.0;
    double hand_height_ratio = 0.0, hand_height_sd_ratio = 0.0;  ///< Ratio to the body height.
    double surface_height_m = 0.0;  ///< Height of the fluid's surface above the floor.
  };

  /// One perceiver for all procedures; perceiver.h has the equations.
  struct Perceiver {
    double weber_fraction = 0.0, weber_fraction_sd_ln = 0.0;  ///< For the total felt viscosity.
    std::string noise;                                        ///< "normal" or "weibull".
    /// Standard deviation between persons.
    double criterion_sd_ln = 0.0;
    /// Standard deviation of a person's drift in each trial.
    double criterion_drift_per_trial_ln = 0.0;
    double lapse_rate = 0.0;  ///< [0, 0.5)
    double exponent = 0.0, exponent_sd = 0.0;
    /// Ratio of the felt to the remembered water at scale 1.
    double unit = 0.0, unit_sd_ln = 0.0;
    double standard_damping_n_s_per_m = 0.0;  ///< Remembered damping of real water.
    /// Weight of the percept against the centre of the range; 1 means that only the percept
    /// counts.
    double shrink = 0.0;
    double shrink_sd_ln = 0.0;        ///< Standard deviation of 1 - shrink between persons.
    double centre_ratio = 0.0;        ///< Centre of the range, in units of the standard.
    double anchor_ratio = 0.0;        ///< Weight of the starting value in production, [0, 1).
    double assimilation_ratio = 0.0;  ///< Weight of the previous answer, (-1, 1).
    double learning_ratio = 0.0;      ///< Additional noise in the first trial of a block.
    /// Trials until the additional noise has fallen to 37 %, > 0.
    double learning_trials = 0.0;
    double fatigue_ratio_per_trial = 0.0;  ///< Increase of noise with each trial.
    double look_again_probability = 0.0;   ///< [0, 1)
    /// A person who is less certain than this says "cannot tell", if the block allows it, [0,
    /// 1].
    double cannot_tell_certainty = 0.2;
    /// Production: largest difference that passes for equal, > 0.
    double match_tolerance_ln = 0.0;
    /// Production: a larger difference takes a coarse step, > 0.
    double coarse_step_ln = 0.0;
    /// Number for water of people who choose their own modulus, > 0. Without it, nobody can
    /// choose one.
    std::optional<double> free_modulus;
    double free_modulus_sd_ln = 0.0;  ///< Standard deviation between persons.
  };

  /// How persons press a solid, and how they feel its stiffness, which the device's own
  /// viscosity does not change. Everything else is as in the perceiver.
  struct Pressing {
    double weber_fraction, weber_fraction_sd_ln;  ///< For stiffness, > 0.
    double detection_threshold_n_per_m;           ///< Remembered stiffness of free space, > 0.
    double standard_stiffness_n_per_m;            ///< Stiffness of a magnitude of 100 %, > 0.
    double depth_m;  ///< Depth below the surface to which the arm pulls the hand, > 0.
    /// Height above the surface to which the hand rises between two presses, > 0.
    double lift_m;
    double period_s;    ///< Duration of one press, > 0.
    double sideways_m;  ///< Amplitude of the movement along the surface meanwhile, > 0.
  };

  /// How persons answer a question after a trial: what the answer depends on, and its scatter.
  /// A question without an entry is answered like one of a questionnaire, independently of the
  /// stimulus.
  struct Question {
    std::string follows;  ///< "certainty" or "magnitude"; see trial_feeling.h.
    /// Standard deviation of the answer over the length of its scale, >= 0.
    double noise_sd_ratio = 0.0;
  };

  /// What persons answer about themselves and in questionnaires.
  struct Answers {
    double age_years = 0.0, age_sd_years = 0.0;
    double right_handed_probability = 0.0;
    /// Probability of "yes" to a yes/no question of a questionnaire.
    double yes_probability = 0.0;
    /// Probability that a person calls the material touched afterwards a solid.
    double solid_probability = 0.0;
    /// 0 is the worst step, 1 the best.
    double scale_step_ratio = 0.0, scale_step_sd_ratio = 0.0;
  };

  /// What conditions do to people. All effects that apply to a block, by its levels and those
  /// of the person, are combined: factors multiply, differences add.
  struct Effect {
    /// The effect applies if all of these hold. `block` is the name of a block.
    Levels levels;
    /// Factor on the Weber fraction, for total felt viscosity or for stiffness, > 0.
    double weber_fraction_factor = 1.0, weber_fraction_sd_ln = 0.0;
    /// Factor on the intensity that feels equal to the reference or the standard, > 0; a bias.
    double pse_factor = 1.0, pse_sd_ln = 0.0;
    double exponent_difference = 0.0, exponent_sd = 0.0;
    /// Factor on the numbers that people say, > 0.
    double magnitude_factor = 1.0, magnitude_sd_ln = 0.0;
    /// Difference of a rating, in steps.
    double rating_difference = 0.0, rating_sd = 0.0;
  };

  std::string name;
  std::string title;
  std::string text;  ///< The file word for word, which is stored with every session.
  Device device;
  Arm arm;
  Movement movement;
  std::map<std::string, Strokes> strokes;  ///< By procedure; "default" is for all others.
  Perceiver perceiver;
  std::optional<Pressing> pressing;  ///< None if these people cannot be asked about solids.
  Answers answers;
  std::vector<Effect> effects;  ///< Empty if conditions change nothing by themselves.
  std::map<std::string, Question> questions;  ///< By their names in study files.
  /// Names of estimates, as in results, to which parameters were fitted.
  std::vector<std::string> calibrated_on;
  /// Names of estimates that follow from those, nearly or exactly.
  std::vector<std::string> implied;

  [[nodiscard]] const Strokes& strokes_for(const std::string& procedure) const;
};

/// Throws `Error` with every problem found: missing and unknown keys, wrong types, values out
/// of range.
[[nodiscard]] Laboratory read_laboratory(const std::filesystem::path& file);
[[nodiscard]] Laboratory parse_laboratory(const std::string& text, const std::string& place);

}  // namespace jnd::experiments
