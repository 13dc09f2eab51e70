#include "experiments/participants/perceiver.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random_stream.h"

namespace jnd::experiments {
namespace {

using core::RandomStream;

/// Returns noise with mean 0 and standard deviation 1 from the chosen family.
double unit_noise(const std::string& family, RandomStream& stream) {
  if (family != "weibull") return stream.normal();
  // The ln of a Weibull variable is a Gumbel variable, with mean -0.5772 and sd pi / sqrt 6.
  const double gumbel = std::log(-std::log(1.0 - stream.uniform()));
  return (gumbel + std::numbers::egamma) * std::sqrt(6.0) / std::numbers::pi;
}

/// Rounds to steps of 5, 10, 25 and 50, as people do, with finer steps for smaller numbers.
double rounded_percent(double percent) {
  double step = 5.0;
  if (percent >= 50.0) step = 10.0;
  if (percent >= 200.0) step = 25.0;
  if (percent >= 400.0) step = 50.0;
  return step * std::round(percent / step);
}

/// `number` > 0.
double to_two_digits(double number) {
  const double step = std::pow(10.0, std::floor(std::log10(number)) - 1.0);
  return step * std::round(number / step);
}

}  // namespace

Person draw_person(const Laboratory& laboratory, std::uint64_t session_seed) {
  const Laboratory::Perceiver& p = laboratory.perceiver;
  const Laboratory::Movement& m = laboratory.movement;
  // Each trait has a stream of its own, so that another spread of one trait in the population
  // does not change the others.
  const auto z = [&](const char* trait) {
    return RandomStream(session_seed, std::string("person/") + trait).normal();
  };
  Person person;
  person.weber_fraction =
      p.weber_fraction * std::exp(p.weber_fraction_sd_ln * z("weber_fraction"));
  person.criterion_ln = p.criterion_sd_ln * z("criterion");
  person.criterion_drift_per_trial_ln = p.criterion_drift_per_trial_ln * z("drift");
  person.exponent = std::max(0.05, p.exponent + p.exponent_sd * z("exponent"));
  person.unit = p.unit * std::exp(p.unit_sd_ln * z("unit"));
  person.shrink =
      std::clamp(1.0 - (1.0 - p.shrink) * std::exp(p.shrink_sd_ln * z("shrink")), 0.05, 1.0);
  person.body_height_m = m.body_height_m + m.body_height_sd_m * z("body_height");
  person.hand_height_m =
      (m.hand_height_ratio + m.hand_height_sd_ratio * z("hand_height")) * person.body_height_m;
  RandomStream other(session_seed, "person/other");
  person.right_handed = other.with_probability(laboratory.answers.right_handed_probability);
  person.age_years = static_cast<int>(std::lround(std::max(
      18.0, other.normal(laboratory.answers.age_years, laboratory.answers.age_sd_years))));
  person.amplitude_score = z("amplitude");
  person.max_speed_m_per_s = m.max_speed_m_per_s * std::exp(m.max_speed_sd_ln * z("max_speed"));
  if (laboratory.pressing) {
    const Laboratory::Pressing& pressing = *laboratory.pressing;
    person.stiffness_weber_fraction =
        pressing.weber_fraction *
        std::exp(pressing.weber_fraction_sd_ln * z("stiffness_weber_fraction"));
  }
  if (p.free_modulus) {
    person.free_modulus = *p.free_modulus * std::exp(p.free_modulus_sd_ln * z("free_modulus"));
  }
  return person;
}

Perceiver::Perceiver(const Laboratory& laboratory, const Person& person,
                     std::uint64_t session_seed, Feels feels)
    : laboratory_(laboratory),
      person_(person),
      seed_(session_seed),
      weber_fraction_(person.weber_fraction),
      free_space_(laboratory.device.mechanical_viscosity_n_s_per_m),
      standard_(laboratory.perceiver.standard_damping_n_s_per_m) {
  if (feels == Feels::kDamping) return;
  weber_fraction_ = person.stiffness_weber_fraction;
  free_space_ = 0.0;
  threshold_ = laboratory.pressing.value().detection_threshold_n_per_m;
  standard_ = laboratory.pressing->standard_stiffness_n_per_m;
}

double Perceiver::free_space_ln() const { return std::log(std::max(free_space_, threshold_)); }

double Perceiver::reading_ln(double felt, const Moment& moment) const {
  const Laboratory::Perceiver& p = laboratory_.perceiver;
  const auto trial = static_cast<double>(moment.trial_in_block - 1);
  const double learning = 1.0 + p.learning_ratio * std::exp(-trial / p.learning_trials);
  const double fatigue = 1.0 + p.fatigue_ratio_per_trial * trial;
  const double sd = std::log1p(weber_fraction_) / std::numbers::sqrt2 * learning * fatigue;
  RandomStream stream(seed_, "reading", {moment.trial, moment.attempt, moment.presentation});
  return std::log(std::max(felt, threshold_)) + sd * unit_noise(p.noise, stream);
}

bool Perceiver::lapses(const Moment& moment) const {
  return RandomStream(seed_, "lapse", {moment.trial, moment.attempt})
      .with_probability(2.0 * laboratory_.perceiver.lapse_rate);
}

bool Perceiver::guesses_yes(const Moment& moment) const {
  return RandomStream(seed_, "guess", {moment.trial, moment.attempt}).with_probability(0.5);
}

double Perceiver::criterion_ln(const Moment& moment) const {
  return person_.criterion_ln +
         person_.criterion_drift_per_trial_ln * static_cast<double>(moment.trial_in_block - 1);
}

bool Perceiver::says_thicker(double test_ln, double reference_ln, const Moment& moment) const {
  // A lapse is a guess, and half of the guesses are right, so the curve ends at lapse_rate.
  if (lapses(moment)) return guesses_yes(moment);
  return test_ln - reference_ln > criterion_ln(moment);
}

bool Perceiver::says_present(double test_ln, double free_space_ln, const Moment& moment) const {
  if (lapses(moment)) return guesses_yes(moment);
  return test_ln - free_space_ln > std::log1p(weber_fraction_);
}

bool Perceiver::says_different(double first_ln, double second_ln, const Moment& moment) const {
  return says_present(std::abs(second_ln - first_ln), 0.0, moment);
}

int Perceiver::choose_interval(Task task, std::span<const double> readings_ln,
                               const Moment& moment) const {
  if (!lapses(moment)) return chosen_interval(task, readings_ln).interval;
  const TrialForm form = form_of(task);
  RandomStream stream(seed_, "guess", {moment.trial, moment.attempt});
  return form.first_choice +
         static_cast<int>(stream.below(static_cast<std::uint64_t>(form.num_choices)));
}

double Perceiver::certainty_of_choice(Task task, std::span<const double> readings_ln,
                                      int num_looks, const Moment& moment) const {
  return certainty(chosen_interval(task, readings_ln).margin, std::log1p(weber_fraction_),
                   num_looks, moment);
}

double Perceiver::certainty(double distance_ln, double noise_sd_ln, int num_looks,
                            const Moment& moment) const {
  if (lapses(moment)) return 0.0;
  const double z = std::abs(distance_ln) * std::sqrt(num_looks) / noise_sd_ln;
  return std::erf(z / std::numbers::sqrt2);  // 2 Phi(z) - 1
}

double Perceiver::certainty_of_thicker(double test_ln, double reference_ln, int num_looks,
                                       const Moment& moment) const {
  return certainty(test_ln - reference_ln - criterion_ln(moment), std::log1p(weber_fraction_),
                   num_looks, moment);
}

double Perceiver::certainty_of_present(double test_ln, double free_space_ln, int num_looks,
                                       const Moment& moment) const {
  const double jnd_ln = std::log1p(weber_fraction_);
  return certainty(test_ln - free_space_ln - jnd_ln, jnd_ln / std::numbers::sqrt2, num_looks,
                   moment);
}

double Perceiver::certainty_of_different(double first_ln, double second_ln, int num_looks,
                                         const Moment& moment) const {
  const double jnd_ln = std::log1p(weber_fraction_);
  return certainty(std::abs(second_ln - first_ln) - jnd_ln, jnd_ln, num_looks, moment);
}

double Perceiver::magnitude_ln(double reading_ln) const {
  const double excess = std::exp(reading_ln) - free_space_;
  if (!(excess > 0.0)) return -INFINITY;
  return std::log(person_.unit) + person_.exponent * std::log(excess / standard_);
}

double Perceiver::reading_of_magnitude_ln(double magnitude_ln) const {
  if (!std::isfinite(magnitude_ln)) return free_space_ln();
  const double excess =
      standard_ * std::exp((magnitude_ln - std::log(person_.unit)) / person_.exponent);
  return std::log(std::max(free_space_ + excess, threshold_));
}

double Perceiver::centre_ln() const {
  return std::log(person_.unit) +
         person_.exponent * std::log(laboratory_.perceiver.centre_ratio);
}

std::optional<double> Perceiver::answer_ln(double reading_ln, double unit_ln,
                                           const Moment& moment,
                                           std::optional<double> previous_ratio) const {
  const double its_centre_ln = centre_ln() - unit_ln;
  if (lapses(moment)) {
    RandomStream stream(seed_, "guess", {moment.trial, moment.attempt});
    return its_centre_ln + 0.3 * stream.normal();
  }
  const double felt_ln = magnitude_ln(reading_ln) - unit_ln;
  if (!std::isfinite(felt_ln)) return std::nullopt;
  double ratio_ln = person_.shrink * felt_ln + (1.0 - person_.shrink) * its_centre_ln;
  if (previous_ratio && *previous_ratio > 0.0) {
    ratio_ln +=
        laboratory_.perceiver.assimilation_ratio * (std::log(*previous_ratio) - ratio_ln);
  }
  return ratio_ln;
}

double Perceiver::estimate_percent(double reading_ln, const Moment& moment,
                                   std::optional<double> previous_percent) const {
  if (previous_percent) *previous_percent /= 100.0;
  const std::optional<double> ratio_ln = answer_ln(reading_ln, 0.0, moment, previous_percent);
  return ratio_ln ? rounded_percent(100.0 * std::exp(*ratio_ln)) : 0.0;
}

double Perceiver::estimate_number(double reading_ln, const Moment& moment,
                                  std::optional<double> previous,
                                  const Counting& counting) const {
  // A stimulus that is hardly felt gets a small number, because 0 means nothing.
  constexpr double kLeastRatio = 0.01;
  double unit_ln = counting.standard_ln ? magnitude_ln(*counting.standard_ln) : 0.0;
  if (!std::isfinite(unit_ln)) unit_ln = 0.0;  // The standard was not felt at all.
  if (previous) *previous /= counting.number;
  const std::optional<double> ratio_ln = answer_ln(reading_ln, unit_ln, moment, previous);
  const double ratio = ratio_ln ? std::max(kLeastRatio, std::exp(*ratio_ln)) : kLeastRatio;
  if (!counting.in_round_numbers) return to_two_digits(counting.number * ratio);
  return counting.number * std::max(kLeastRatio, rounded_percent(100.0 * ratio) / 100.0);
}

double Perceiver::rate(double magnitude_ratio, int num_steps, const Moment& moment,
                       std::optional<double> previous_step) const {
  if (lapses(moment)) {
    RandomStream stream(seed_, "guess", {moment.trial, moment.attempt});
    return 1.0 + static_cast<double>(stream.below(static_cast<std::size_t>(num_steps)));
  }
  const double last = num_steps - 1;
  double ratio = 0.5 + person_.shrink * (magnitude_ratio - 0.5) + person_.rating_steps / last;
  if (previous_step) {
    ratio += laboratory_.perceiver.assimilation_ratio * ((*previous_step - 1.0) / last - ratio);
  }
  return 1.0 + std::round(last * std::clamp(ratio, 0.0, 1.0));
}

Perceiver::Wish Perceiver::wish(double reading_ln, double first_reading_ln,
                                double target_percent, const Moment&) const {
  const Laboratory::Perceiver& p = laboratory_.perceiver;
  double aim_ln =
      person_.shrink * std::log(target_percent / 100.0) + (1.0 - person_.shrink) * centre_ln();
  const double felt_ln = magnitude_ln(reading_ln);
  const double start_ln = magnitude_ln(first_reading_ln);
  if (std::isfinite(start_ln)) aim_ln += p.anchor_ratio * (start_ln - aim_ln);
  return step_for(felt_ln - aim_ln);
}

Perceiver::Wish Perceiver::wish_to_match(double reading_ln, double first_reading_ln,
                                         double standard_ln, const Moment& moment) const {
  double aim_ln = standard_ln + criterion_ln(moment);
  aim_ln += laboratory_.perceiver.anchor_ratio * (first_reading_ln - aim_ln);
  return step_for(reading_ln - aim_ln);
}

Perceiver::Wish Perceiver::step_for(double difference_ln) const {
  const Laboratory::Perceiver& p = laboratory_.perceiver;
  if (std::abs(difference_ln) <= p.match_tolerance_ln) return Wish::kMatches;
  if (difference_ln < 0.0) {
    return difference_ln < -p.coarse_step_ln ? Wish::kRaiseCoarse : Wish::kRaiseFine;
  }
  return difference_ln > p.coarse_step_ln ? Wish::kLowerCoarse : Wish::kLowerFine;
}

bool Perceiver::looks_again(const Moment& moment) const {
  return RandomStream(seed_, "look", {moment.trial, moment.attempt, moment.presentation})
      .with_probability(laboratory_.perceiver.look_again_probability);
}

}  // namespace jnd::experiments
