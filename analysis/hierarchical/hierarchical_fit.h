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
  std::string condition;   ///< "" where there is one.
  double reference = 0.0;  ///< > 0, unit of the intensities; one and the same in a condition.
  std::vector<AnswerCount> rows;
};

enum class HierarchicalPse {
  kReference,  ///< At the reference for everybody, as the thesis fits.
  kCommon,     ///< Free, the same for everybody.
  kShared,     ///< Free, and people differ: one shift of ln pse a person, in every condition.
  kPersonal,   ///< Free, and people differ by a shift in each condition, independent of others.
};

enum class HierarchicalSlopes {
  kShared,      ///< One deviation a person, the same in every condition.
  kCorrelated,  ///< A deviation in each of two conditions, correlated. With one, as shared.
};

enum class HierarchicalLapses {
  kNone,    ///< Every answer is one of discrimination.
  kKnown,   ///< Half of so large a share of the answers is random as is told.
  kCommon,  ///< A lapse rate, the same for everybody in everything; see `kUsualLapsePrior`.
  /// A lapse rate of each person's own, `lapse_limit` times sin^2(v + tau b), b standard normal
  /// between people. The prior is on the mean share of random answers.
  kPersonal,
};

struct HierarchicalOptions {
  HierarchicalLink link = HierarchicalLink::kLogSlope;
  HierarchicalPse pse = HierarchicalPse::kPersonal;
  HierarchicalSlopes slopes = HierarchicalSlopes::kCorrelated;
  HierarchicalLapses lapses = HierarchicalLapses::kCommon;
  double lapse_rate = 0.0;  ///< Of kKnown: [0, 0.5), with a guess rate below 1 less that.
  /// Share of right answers where nothing is felt, of a forced choice among m 1 / m: [0, 1);
  /// 0 for yes and no.
  double guess_rate = 0.0;
  /// Also what the answers leave open of a lapse rate that is free, in every interval; without
  /// it they hold for the most likely one, and a fit takes a third of the time.
  bool lapse_profile = true;
  /// Of the share of random answers, where the lapse rate is free.
  BetaPrior lapse_prior = kUsualLapsePrior;
  /// Also what values would be without the prior, with half and with twice its weight.
  bool prior_sensitivity = false;
  /// Answers of one person to one level correlate by rho, the same for everybody: a beta
  /// distribution about the curve has drawn their probability (Williams 1975).
  bool beta_binomial = false;
  bool correlation_interval = true;  ///< Of rho; it takes most of the time.
  /// A dimension of how people differ; 0: 15 in one, 9 in two, 5 in three, 3 in more. 1
  /// is Laplace.
  int num_nodes = 0;
};

/// The median person in one condition.
struct HierarchicalCondition {
  std::string condition;
  int num_participants = 0;
  std::optional<double> weber_fraction;
  /// With a profile of the lapse rate, over all that `lapse_rate_with_prior_ci95` has.
  Interval weber_fraction_ci95;
  /// At the lapse rate that the answers alone make most likely; of a profile.
  std::optional<double> weber_fraction_without_prior;
  /// Share of the answers to comparisons at least as easy as the Weber fraction itself, which
  /// the median person gets right in 84.13 % but for lapses.
  double easy_ratio = 0.0;
  std::vector<std::string> cautions;  ///< Levels that are too hard, answers far off.
  /// The goodness of fit of everybody's answers rejects the curves; a caution says so.
  bool is_rejected_by_fit = false;
  std::optional<double> pse;
  std::optional<Interval> pse_ci95;  ///< Absent unless the pse was free.
  double slope_number = 0.0;         ///< a of HierarchicalLink, of the median person.
  std::optional<double> slope_standard_error;
  double place_number = 0.0;
  std::optional<double> place_standard_error;
  /// Least |z| of the median person over the levels that have answers.
  double least_level_z = 0.0;
  /// Between people, of a: with kLogSlope the sd of ln ln(1 + w).
  double slope_sd = 0.0;
  /// Between people, of p, or of q where there is one; 0 unless personal.
  double place_sd = 0.0;
};

/// The second condition's slope number minus the first's, negated with kLogSlope: then it is
/// the difference in ln ln(1 + w), second minus first.
struct HierarchicalDifference {
  std::string first, second;
  double estimate = 0.0;
  std::optional<double> standard_error;  ///< Grown as the intervals are.
  Interval ci95;
  std::optional<double> statistic, p_value;  ///< Student's t, two-sided.
  double degrees_of_freedom = 0.0;
};

/// One participant's Weber fraction, drawn toward the group's by how little the answers say.
struct HierarchicalPersonEstimate {
  std::string participant, condition;
  std::optional<double> weber_fraction;
  std::string reason;                 ///< Why there is none; "" if there is one.
  std::vector<std::string> cautions;  ///< Where it lies beyond the stimuli of the condition.
  std::optional<double> lapse_rate;   ///< Of own lapse rates, this person's at the mode.
};

/// How answers of one person to one level scatter. Log-likelihoods are without binomial
/// coefficients; the test is that of `boundary_test`.
struct HierarchicalScatter {
  double correlation = 0.0;   ///< rho, [0, 1): of two answers.
  Interval correlation_ci95;  ///< Profile likelihood, prior included; none unless asked for.
  // Of the same model with independent answers, where it has an optimum:
  std::optional<double> log_likelihood_without, statistic, p_value;
  std::vector<std::optional<double>> weber_fractions_without;  ///< Of each condition.
};

/// How people's own lapse rates differ, and the same model with one lapse rate for everybody.
struct HierarchicalOwnLapses {
  double angle_sd = 0.0;         ///< tau, between people, of the angle v + tau b [rad].
  double mean_lapse_rate = 0.0;  ///< Over people, where `lapse_rate` is the median person's.
  std::optional<double> common_lapse_rate, log_likelihood_common, statistic, p_value;
  std::vector<std::optional<double>> weber_fractions_common;  ///< Of each condition.
};

/// What the fit would be with another weight of the lapse rate's prior.
struct HierarchicalPriorEffect {
  double weight = 1.0;  ///< Power of the prior's density; 0 is none.
  BetaPrior prior;      ///< With it.
  std::optional<double> lapse_rate;
  std::vector<std::optional<double>> weber_fractions;  ///< Of each condition.
};

struct HierarchicalFit {
  FitStatus status = FitStatus::kNotRun;
  std::string reason;         ///< Why there is no value; "" if there is one.
  bool is_separated = false;  ///< There is none for answers nearly split without overlap.
  std::string method;         ///< The model and its integral, in words.
  int num_participants = 0;
  int num_nodes = 0;
  std::vector<HierarchicalCondition> conditions;
  /// Absent unless it was free or known; of own ones the median person's.
  std::optional<double> lapse_rate;
  // Known if the lapse rate was followed by its profile:
  Interval lapse_rate_ci95;                        ///< Profile likelihood of the answers alone.
  Interval lapse_rate_with_prior_ci95;             ///< The same interval with the prior;
                                                   ///< `weber_fraction_ci95` is over it.
  std::optional<double> lapse_rate_without_prior;  ///< Most likely by the answers alone.
  double guess_rate = 0.0;                         ///< The guess rate that was given.
  std::optional<double> correlation;  ///< Correlation of people's deviations in two conditions.
  std::vector<HierarchicalDifference>
      differences;  ///< Difference of each condition to the first.
  std::vector<HierarchicalPersonEstimate> participants;
  /// How far each person, a column, moves the slope numbers of the conditions and, where they
  /// are free, their place numbers: the parts of the sandwich that differences rest on.
  Eigen::MatrixXd influence;
  std::vector<std::string> people;             ///< Of its columns.
  std::optional<double> log_likelihood;        ///< Without binomial coefficients.
  std::string note;                            ///< What a reader has to know; "" if nothing.
  std::optional<HierarchicalScatter> scatter;  ///< Of beta-binomial answers.
  std::optional<HierarchicalOwnLapses> own_lapses;     ///< Of kPersonal.
  BetaPrior lapse_prior = kUsualLapsePrior;            ///< The prior that was used.
  std::vector<HierarchicalPriorEffect> prior_effects;  ///< Where they were asked for.
};

/// The Weber fraction of a slope number; none where the curve does not rise.
[[nodiscard]] std::optional<double> fraction_at(HierarchicalLink link, double slope_number);

/// Probit curves of everybody at once: people's slopes (and places, where personal) vary
/// normally about the median person's, and the likelihood is integrated over that by adaptive
/// Gauss-Hermite quadrature. The estimand is the median person's Weber fraction, which the
/// pooled curve's is not: pooling people who differ flattens the curve. Perfectly separated or
/// flat participants take part, for it needs no fit of their own.
///
/// Where rows differ in the order of the intervals, each order has a place of its own, and what
/// people differ by is that: the bias for an interval. The pse is then one for all.
///
/// A lapse, an answer at random, counts for much where it is in a very easy comparison; without
/// lapses in the model a few of them make everybody's curve flatter (Wichmann and Hill 2001).
/// So one lapse rate for everybody is fitted, with a prior, unless it is known. Answers to hard
/// comparisons hardly tell it, and where none is found, at its bound 0, the observed
/// information says nothing of how far a few lapses would move the slope. A condition's
/// interval is therefore the union of Wald's, below, over the lapse rates that answers and
/// prior leave, which are those of a 95 % profile interval.
///
/// Intervals are Wald's on the slope number with Student's t at participants - 1 and its error
/// grown by sqrt(n / (n - 1)), because maximum likelihood has the spread of few people too
/// small; data/reference/coverage has what they cover. A condition's error is of the observed
/// information A. A difference's is of the sandwich A^-1 (sum of s s^T) A^-1 over people's
/// scores s (Huber 1967; Liang and Zeger 1986), which with many answers is that of the paired t
/// test. By A alone a difference's interval is too wide: most of its error is the chance of the
/// answers, which is known and yet gets the t of a spread of n people, and a spread of
/// differences that is estimated cannot be below 0. Where the scores are all alike there is no
/// interval.
///
/// With own lapse rates the lapse rate that is followed is the median person's, and the profile
/// of the answers alone is left out. With beta-binomial answers nothing is said of answers that
/// lie far from people's curves, for rho is there for that.
///
/// `degenerate` where a condition's pooled answers are, or with fewer than two participants, or
/// where beta-binomial answers are all single ones.
/// Throws `core::Error` for references or counts as `fit_psychometric`, references that differ
/// within a condition, two entries of a participant in one, rates out of range, and for more
/// conditions than the model takes: two with correlated slopes, else eight, or four with
/// personal pses.
[[nodiscard]] HierarchicalFit fit_hierarchical(const std::vector<ParticipantAnswers>& answers,
                                               const HierarchicalOptions& options);

}  // namespace jnd::analysis
