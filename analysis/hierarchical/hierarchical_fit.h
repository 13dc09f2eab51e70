#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "analysis/fits/psychometric_fit.h"
#include "analysis/hierarchical/hierarchical_model.h"

namespace jnd::analysis {

/// What one participant answered in one condition.
struct ParticipantAnswers {
  std::string participant;
  std::string condition;  ///< The condition; "" if there is only one.
  /// The reference, > 0, in the unit of the intensities. It must be the same throughout a
  /// condition.
  double reference = 0.0;
  std::vector<AnswerCount> rows;
};

enum class HierarchicalPse {
  kReference,  ///< The pse of everybody is at the reference, as in the thesis.
  kCommon,     ///< The pse is free and the same for everybody.
  /// The pse is free and people differ. Each person shifts ln pse by the same amount in every
  /// condition.
  kShared,
  /// The pse is free and people differ. Each person has an independent shift of ln pse in each
  /// condition.
  kPersonal,
};

enum class HierarchicalSlopes {
  kShared,  ///< Each person has one deviation of the slope, the same in every condition.
  /// Each person has a deviation in each of two conditions, and these are correlated. With one
  /// condition it equals kShared.
  kCorrelated,
};

enum class HierarchicalLapses {
  kNone,  ///< There are no lapses.
  /// The lapse rate is given. For yes-no answers it is half the share of random answers.
  kKnown,
  /// One free lapse rate holds for everybody in every condition; see `kUsualLapsePrior`.
  kCommon,
  /// Each person has a lapse rate, `lapse_limit` times sin^2(v + tau b), where b is standard
  /// normal over people. The prior is on the mean share of random answers.
  kPersonal,
};

struct HierarchicalOptions {
  HierarchicalLink link = HierarchicalLink::kLogSlope;
  HierarchicalPse pse = HierarchicalPse::kPersonal;
  HierarchicalSlopes slopes = HierarchicalSlopes::kCorrelated;
  HierarchicalLapses lapses = HierarchicalLapses::kCommon;
  /// The lapse rate of kKnown, in [0, 0.5). With a guess rate it must be below 1 minus that
  /// rate.
  double lapse_rate = 0.0;
  /// The share of right answers if nothing is felt, in [0, 1): 1 / m for a forced choice among
  /// m, and 0 for yes-no answers.
  double guess_rate = 0.0;
  /// Whether every interval includes the uncertainty of a free lapse rate. Without it the
  /// intervals hold for the most likely lapse rate, and a fit takes a third of the time.
  bool lapse_profile = true;
  /// The prior of the share of random answers if the lapse rate is free.
  BetaPrior lapse_prior = kUsualLapsePrior;
  /// Whether to compute the values without the prior, and with half and twice its weight, too.
  bool prior_sensitivity = false;
  /// Whether answers of one person to one level correlate by rho, the same for everybody: their
  /// probability is drawn from a beta distribution about the curve (Williams 1975).
  bool beta_binomial = false;
  /// Whether to compute the interval of rho, which takes most of the time.
  bool correlation_interval = true;
  /// The number of quadrature nodes in each dimension in which people differ. 0 means 15 in one
  /// dimension, 9 in two, 5 in three and 3 in more. 1 is Laplace's approximation.
  int num_nodes = 0;
};

/// The median person in one condition.
struct HierarchicalCondition {
  std::string condition;
  int num_participants = 0;
  std::optional<double> weber_fraction;
  /// With a profile of the lapse rate this is the union over all lapse rates in
  /// `lapse_rate_with_prior_ci95`.
  Interval weber_fraction_ci95;
  /// The Weber fraction at the lapse rate that the answers alone make most likely. Only a
  /// profile of the lapse rate gives it.
  std::optional<double> weber_fraction_without_prior;
  /// The share of the answers that belong to comparisons at least as easy as the Weber fraction
  /// itself. Lapses aside, the median person gets that one right with 84.13 %.
  double easy_ratio = 0.0;
  /// Reasons for caution: levels that are too hard, or answers far from the curves.
  std::vector<std::string> cautions;
  /// Whether the goodness of fit of everybody's answers rejects the curves. A caution then says
  /// so.
  bool is_rejected_by_fit = false;
  std::optional<double> pse;
  std::optional<Interval> pse_ci95;  ///< The interval is absent unless the pse was free.
  /// The number a of `HierarchicalLink` for the median person.
  double slope_number = 0.0;
  std::optional<double> slope_standard_error;
  double place_number = 0.0;
  std::optional<double> place_standard_error;
  /// The least |z| of the median person over the levels that have answers.
  double least_level_z = 0.0;
  /// The standard deviation of a between people. With kLogSlope it is that of ln ln(1 + w).
  double slope_sd = 0.0;
  /// The standard deviation between people of p, or of q if there is one. It is 0 unless the
  /// place is personal.
  double place_sd = 0.0;
};

/// The second condition's slope number minus the first's. With kLogSlope it is negated, so it
/// is the difference in ln ln(1 + w), second minus first.
struct HierarchicalDifference {
  std::string first, second;
  double estimate = 0.0;
  /// The standard error, enlarged for few people like the intervals.
  std::optional<double> standard_error;
  Interval ci95;
  std::optional<double> statistic, p_value;  ///< Student's t, two-sided.
  double degrees_of_freedom = 0.0;
};

/// One participant's Weber fraction. It is drawn toward the group's, and the more so the less
/// the answers tell.
struct HierarchicalPersonEstimate {
  std::string participant, condition;
  std::optional<double> weber_fraction;
  std::string reason;  ///< Why there is no value; "" if there is one.
  /// Cautions if the value lies beyond the stimuli of the condition.
  std::vector<std::string> cautions;
  /// The person's lapse rate at the mode, if people have lapse rates of their own.
  std::optional<double> lapse_rate;
};

/// How answers of one person to one level scatter. Log-likelihoods are without binomial
/// coefficients. The test is `boundary_test`.
struct HierarchicalScatter {
  double correlation = 0.0;  ///< The correlation rho of two answers, in [0, 1).
  /// The profile-likelihood interval with the prior. It is open unless it was asked for.
  Interval correlation_ci95;
  // These belong to the same model with independent answers, if that has an optimum.
  std::optional<double> log_likelihood_without, statistic, p_value;
  /// The Weber fractions of all conditions with independent answers.
  std::vector<std::optional<double>> weber_fractions_without;
};

/// How people's lapse rates differ, and the same model with one lapse rate for everybody.
struct HierarchicalOwnLapses {
  /// The standard deviation tau between people of the angle v + tau b [rad].
  double angle_sd = 0.0;
  /// The mean over people. `lapse_rate` is that of the median person.
  double mean_lapse_rate = 0.0;
  std::optional<double> common_lapse_rate, log_likelihood_common, statistic, p_value;
  /// The Weber fractions of all conditions with one lapse rate.
  std::vector<std::optional<double>> weber_fractions_common;
};

/// The fit with another weight of the lapse rate's prior.
struct HierarchicalPriorEffect {
  double weight = 1.0;  ///< The power to which the prior's density is raised; 0 means no prior.
  BetaPrior prior;      ///< The prior with this weight.
  std::optional<double> lapse_rate;
  /// The Weber fractions of all conditions.
  std::vector<std::optional<double>> weber_fractions;
};

struct HierarchicalFit {
  FitStatus status = FitStatus::kNotRun;
  std::string reason;  ///< Why there is no value; "" if there is one.
  /// There is no fit because the answers are split almost without overlap.
  bool is_separated = false;
  std::string method;  ///< The model and its integral in words.
  int num_participants = 0;
  int num_nodes = 0;
  std::vector<HierarchicalCondition> conditions;
  /// The lapse rate, if it was free or known. If people have lapse rates of their own, that of
  /// the median person.
  std::optional<double> lapse_rate;
  // The following are present if a profile of the lapse rate was computed.
  Interval lapse_rate_ci95;  ///< The profile-likelihood interval from the answers alone.
  /// The same interval with the prior. `weber_fraction_ci95` covers all lapse rates in it.
  Interval lapse_rate_with_prior_ci95;
  /// The lapse rate that the answers alone make most likely.
  std::optional<double> lapse_rate_without_prior;
  double guess_rate = 0.0;  ///< The guess rate that was given.
  /// The correlation of people's deviations in two conditions.
  std::optional<double> correlation;
  std::vector<HierarchicalDifference>
      differences;  ///< The difference of each condition from the first.
  std::vector<HierarchicalPersonEstimate> participants;
  /// How far each person (a column) moves the slope numbers of the conditions and, if they are
  /// free, their place numbers. These are the terms of the sandwich estimator on which
  /// differences rest.
  Eigen::MatrixXd influence;
  /// The participants in the order of its columns.
  std::vector<std::string> people;
  /// The log-likelihood without binomial coefficients.
  std::optional<double> log_likelihood;
  std::string note;                            ///< What a reader has to know; "" if nothing.
  std::optional<HierarchicalScatter> scatter;  ///< The scatter of beta-binomial answers.
  /// Present with `HierarchicalLapses::kPersonal`.
  std::optional<HierarchicalOwnLapses> own_lapses;
  BetaPrior lapse_prior = kUsualLapsePrior;  ///< The prior that was used.
  /// The effects of the prior's weight, if they were asked for.
  std::vector<HierarchicalPriorEffect> prior_effects;
};

/// The Weber fraction of a slope number. It is absent if the curve does not rise.
[[nodiscard]] std::optional<double> fraction_at(HierarchicalLink link, double slope_number);

/// Fits probit curves of everybody at once. People's slopes (and places, if personal) vary
/// normally about those of the median person. Adaptive Gauss-Hermite quadrature integrates the
/// likelihood over this variation. The estimand is the median person's Weber fraction. The
/// pooled curve does not give it, because pooling people who differ flattens the curve.
/// Participants with perfectly separated or flat answers take part, because they need no fit of
/// their own.
///
/// If rows differ in the order of the intervals, each order has its own place, and people
/// differ in it: it is their bias for an interval. The pse is then the same for everybody.
///
/// A lapse is an answer at random. It weighs heavily in a very easy comparison. If the model
/// has no lapses, a few of them make everybody's curve flatter (Wichmann and Hill 2001). The
/// fit therefore has one lapse rate for everybody, with a prior, unless the rate is known.
/// Answers to hard comparisons hardly determine the rate. If it is found at its bound 0, the
/// observed information does not show how far a few lapses would move the slope. A condition's
/// interval is therefore the union of Wald's intervals over the lapse rates in the 95 % profile
/// interval of answers and prior.
///
/// Wald's intervals are computed for the slope number, with Student's t at participants - 1.
/// Their error is enlarged by sqrt(n / (n - 1)), because maximum likelihood underestimates the
/// spread of few people. data/reference/coverage reports their coverage. The error of a
/// condition comes from the observed information A. The error of a difference comes from the
/// sandwich A^-1 (sum of s s^T) A^-1 over people's scores s (Huber 1967; Liang and Zeger 1986).
/// With many answers it equals that of the paired t test. A alone would make a difference's
/// interval too wide, for two reasons. Most of its error is the sampling error of the answers,
/// which is known and yet would get the t of a spread of n people. And an estimated spread of
/// differences cannot be below 0. If all scores are equal there is no interval.
///
/// If people have lapse rates of their own, the profile follows the median person's rate, and
/// the profile of the answers alone is left out. With beta-binomial answers the fit does not
/// report answers that lie far from people's curves, because rho covers them.
///
/// The status is `degenerate` if the pooled answers of a condition are, if there are fewer than
/// two participants, or if beta-binomial answers are all single ones. Throws `core::Error` for
/// references or counts as `fit_psychometric` does, for references that differ within a
/// condition, for two entries of a participant in a condition, and for rates out of range. It
/// also throws for more conditions than the model takes: two with correlated slopes, four with
/// personal pses, and otherwise eight.
[[nodiscard]] HierarchicalFit fit_hierarchical(const std::vector<ParticipantAnswers>& answers,
                                               const HierarchicalOptions& options);

}  // namespace jnd::analysis
