#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/study/design.h"

namespace jnd::experiments {

/// A simulated laboratory: an apparatus with its imperfections and a population of
/// participants, read from a file. Every number comes with its basis: "thesis", "calibrated" or
/// "assumption".
struct Laboratory {
  /// The lumped hand.
  struct Device {
    double mass_kg = 0.0;                         ///< Hand, fingers and arm as felt, > 0.
    double mechanical_viscosity_n_s_per_m = 0.0;  ///< What free space feels like, >= 0.
    double dry_friction_n = 0.0;                  ///< >= 0.
    double max_force_per_point_n = 0.0;           ///< Force limiter, > 0.
    double max_total_force_n = 0.0;               ///< Force limiter, > 0.
    double max_slew_n_per_s = 0.0;                ///< Force limiter, > 0.
  };

  /// A normal or log-normal spread between persons.
  struct Spread {
    double mean = 0.0;
    double sd = 0.0;  ///< In ln where the mean is a ratio or size, see each use.
  };

  struct Arm {
    double stiffness_n_per_m = 0.0;  ///< >= 0.
    double damping_n_s_per_m = 0.0;  ///< >= 0.
    double home_s = 0.0;             ///< Time to come to rest between trials, > 0.
  };

  /// How persons stroke under one procedure. Spreads between persons are in ln.
  struct Strokes {
    double amplitude_m = 0.0, amplitude_sd_ln = 0.0;
    int strokes_per_presentation = 1;  ///< Full cycles, >= 1.
  };
  /// What strokes have in common.
  struct Movement {
    double max_speed_m_per_s = 0.0,
           max_speed_sd_ln = 0.0;  ///< Largest speed of the reference, and its spread.
    double stroke_amplitude_sd_ratio = 0.0, stroke_speed_sd_ratio = 0.0;  ///< Within a person.
    double stroke_height_sd_m = 0.0;
    double lift_m = 0.0;  ///< Lower on the way forward, higher on the way back.
    double body_height_m = 0.0, body_height_sd_m = 0.0;
    double hand_height_ratio = 0.0, hand_height_sd_ratio = 0.0;  ///< Over body height.
    double surface_height_m = 0.0;  ///< Height of the fluid's surface above the floor.
  };

  /// One perceiver for all procedures; see perceiver.h for the equations.
  struct Perceiver {
    double weber_fraction = 0.0, weber_fraction_sd_ln = 0.0;  ///< For total felt viscosity.
    std::string noise;                                        ///< "normal" or "weibull".
    double criterion_sd_ln = 0.0;                             ///< Between persons.
    double criterion_drift_per_trial_ln = 0.0;  ///< Sd of a person's drift, per trial.
    double lapse_rate = 0.0;                    ///< [0, 0.5)
    double exponent = 0.0, exponent_sd = 0.0;
    double unit = 0.0, unit_sd_ln = 0.0;      ///< Felt ratio to remembered water at scale 1.
    double standard_damping_n_s_per_m = 0.0;  ///< What real water is remembered to feel like.
    double shrink = 0.0;  ///< Weight of the percept against the range's centre; 1 is none.
    double shrink_sd_ln = 0.0;        ///< Of 1 - shrink, between persons.
    double centre_ratio = 0.0;        ///< Centre of the range, in standards.
    double anchor_ratio = 0.0;        ///< Weight of the starting value in production, [0, 1).
    double assimilation_ratio = 0.0;  ///< Pull of the answer before, (-1, 1).
    double learning_ratio = 0.0;      ///< Extra noise at the first trial of a block.
    double learning_trials = 0.0;     ///< Trials until it has fallen to 37 %, > 0.
    double fatigue_ratio_per_trial = 0.0;  ///< Noise gained a trial.
    double look_again_probability = 0.0;   ///< [0, 1)
    /// Who is less certain says "cannot tell", where that is an answer, [0, 1].
    double cannot_tell_certainty = 0.2;
    double match_tolerance_ln = 0.0;  ///< Production: what passes for equal, > 0.
    double coarse_step_ln = 0.0;      ///< Production: beyond this, a coarse step, > 0.
    /// The number that people give water who choose their own, > 0; without it nobody does.
    std::optional<double> free_modulus;
    double free_modulus_sd_ln = 0.0;  ///< Between persons.
  };

  /// How persons press a solid and what they feel of it: its stiffness, in which the device's
  /// own viscosity plays no role. Everything else is the perceiver's.
  struct Pressing {
    double weber_fraction, weber_fraction_sd_ln;  ///< For stiffness, > 0.
    double detection_threshold_n_per_m;  ///< What nothing is remembered to feel like, > 0.
    double standard_stiffness_n_per_m;   ///< What a magnitude of 100 % is, > 0.
    double depth_m;     ///< How far below the surface the arm pulls the hand, > 0.
    double lift_m;      ///< How far above it the hand goes between two presses, > 0.
    double period_s;    ///< How long one press takes, > 0.
    double sideways_m;  ///< Half the way to and fro along the surface meanwhile, > 0.
  };

  /// How persons answer a question that follows trials: what their answer goes with, and with
  /// how much scatter. A question without an entry is answered as a questionnaire is, whatever
  /// was felt.
  struct Question {
    std::string follows;          ///< "certainty" or "magnitude"; see trial_feeling.h.
    double noise_sd_ratio = 0.0;  ///< Of the answer, over the length of its scale, >= 0.
  };

  /// What persons say of themselves and on paper.
  struct Answers {
    double age_years = 0.0, age_sd_years = 0.0;
    double right_handed_probability = 0.0;
    double yes_probability = 0.0;    ///< To a yes/no question of a questionnaire.
    double solid_probability = 0.0;  ///< That what was touched afterwards is called so.
    double scale_step_ratio = 0.0, scale_step_sd_ratio = 0.0;  ///< 0 worst, 1 best.
  };

  /// What conditions do to people. What applies to a block, by its levels and those of the
  /// person, is taken together: factors multiply, differences add.
  struct Effect {
    Levels levels;  ///< All of these have to hold; `block` is the name of a block.
    /// Of the Weber fraction, for total felt viscosity or for stiffness, > 0.
    double weber_fraction_factor = 1.0, weber_fraction_sd_ln = 0.0;
    /// Of what feels equal to the reference or the standard, > 0: a bias.
    double pse_factor = 1.0, pse_sd_ln = 0.0;
    double exponent_difference = 0.0, exponent_sd = 0.0;
    double magnitude_factor = 1.0, magnitude_sd_ln = 0.0;  ///< Of what numbers say, > 0.
    double rating_difference = 0.0, rating_sd = 0.0;       ///< Of a rating, in steps.
  };

  std::string name;
  std::string title;
  std::string text;  ///< The file word for word; stored with every session.
  Device device;
  Arm arm;
  Movement movement;
  std::map<std::string, Strokes> strokes;  ///< By procedure; "default" for any other.
  Perceiver perceiver;
  std::optional<Pressing> pressing;  ///< None: nobody is asked about solids.
  Answers answers;
  std::vector<Effect> effects;  ///< None where conditions do nothing of themselves.
  std::map<std::string, Question> questions;  ///< By their names in study files.
  /// Names of estimates, as in results, that parameters were fitted to.
  std::vector<std::string> calibrated_on;
  /// Names of estimates that follow from those, nearly or wholly.
  std::vector<std::string> implied;

  [[nodiscard]] const Strokes& strokes_for(const std::string& procedure) const;
};

/// Throws `Error` with every problem found: missing and unknown keys, wrong types, out of
/// range.
[[nodiscard]] Laboratory read_laboratory(const std::filesystem::path& file);
[[nodiscard]] Laboratory parse_laboratory(const std::string& text, const std::string& place);

}  // namespace jnd::experiments
