#include "analysis/fits/chance_level.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "analysis/statistics/distributions.h"
#include "core/psychometric_function.h"

namespace jnd::analysis {
namespace {

struct Chance {
  double chance;
  /// The least log ratio of the likelihoods if right answers are many.
  double least_log_ratio;
  double many;  ///< The least share of right answers that counts as many.
};
constexpr std::array<Chance, 3> kChances = {{
    {.chance = 1.0 / 2.0, .least_log_ratio = -0.5, .many = 0.68},
    {.chance = 1.0 / 3.0, .least_log_ratio = 1.0, .many = 0.62},
    {.chance = 1.0 / 4.0, .least_log_ratio = 1.0, .many = 0.62},
}};

struct Level {
  double place = 0.0;  ///< ln of the intensity; -infinity for an intensity of 0.
  double yes = 0.0, trials = 0.0;
};

double log_likelihood(double yes, double trials, double probability) {
  double value = 0.0;
  if (yes > 0.0) value += yes * std::log(probability);
  if (yes < trials) value += (trials - yes) * std::log1p(-probability);
  return value;
}

/// At most 60 levels, by ascending intensity.
std::vector<Level> levels_of(const std::vector<AnswerCount>& rows) {
  constexpr double kMostLevels = 60.0;
  std::map<double, Level> by_intensity;
  double all = 0.0;
  for (const AnswerCount& row : rows) {
    if (row.num_trials <= 0) continue;
    Level& level = by_intensity[row.intensity];
    level.place = std::log(row.intensity);
    level.yes += static_cast<double>(row.num_yes);
    level.trials += static_cast<double>(row.num_trials);
    all += static_cast<double>(row.num_trials);
  }
  const double least =
      static_cast<double>(by_intensity.size()) > kMostLevels ? all / kMostLevels : 0.0;
  std::vector<Level> levels;
  for (const auto& [intensity, level] : by_intensity) {
    const bool full =
        levels.empty() || levels.back().trials >= least || !std::isfinite(levels.back().place);
    if (full) {
      levels.push_back(level);
      continue;
    }
    Level& last = levels.back();
    const double both = last.trials + level.trials;
    last.place = (last.place * last.trials + level.place * level.trials) / both;
    last.yes += level.yes;
    last.trials = both;
  }
  return levels;
}

/// Twice the log-likelihood that the best rising curve loses if it must stay at or above the
/// chance.
double loss_at_or_above(const std::vector<Level>& levels, double chance) {
  std::vector<Level> pools;  // Pooling of adjacent violators (Ayer et al. 1955).
  for (const Level& level : levels) {
    pools.push_back(level);
    while (pools.size() > 1) {
      const Level& last = pools.back();
      Level& before = pools[pools.size() - 2];
      if (before.yes * last.trials < last.yes * before.trials) break;
      before.yes += last.yes;
      before.trials += last.trials;
      pools.pop_back();
    }
  }
  double loss = 0.0;
  for (const Level& pool : pools) {
    const double share = pool.yes / pool.trials;
    if (share >= chance) break;
    loss += log_likelihood(pool.yes, pool.trials, share) -
            log_likelihood(pool.yes, pool.trials, chance);
  }
  return 2.0 * loss;
}

/// The logarithms of the best likelihood: first of curves from 0, then of curves from each
/// chance. The search covers a grid of places and slopes, without lapses and with 3 % of them,
/// and flat curves.
std::array<double, 4> best_log_likelihoods(const std::vector<Level>& levels) {
  constexpr int kPlaces = 41, kSlopes = 30;
  constexpr double kFarthest = 3.0, kFlattest = 0.1, kSteepest = 30.0;
  constexpr std::array<double, 2> kLapses = {0.0, 0.03};
  double sum = 0.0, squares = 0.0, finite = 0.0, yes = 0.0, trials = 0.0;
  for (const Level& level : levels) {
    yes += level.yes;
    trials += level.trials;
    if (!std::isfinite(level.place)) continue;
    sum += level.place;
    squares += level.place * level.place;
    finite += 1.0;
  }
  const double mean = finite > 0.0 ? sum / finite : 0.0;
  const double variance = finite > 0.0 ? squares / finite - mean * mean : 0.0;
  const double spread = variance > 0.0 ? std::sqrt(variance) : 1.0;

  std::array<double, 4> best{};
  const auto guess_of = [](std::size_t curve) {
    return curve == 0 ? 0.0 : kChances[curve - 1].chance;
  };
  for (std::size_t curve = 0; curve < best.size(); ++curve) {
    best[curve] = log_likelihood(yes, trials, std::max(yes / trials, guess_of(curve)));
  }
  std::vector<double> tail(levels.size());
  for (int slope_at = 0; slope_at < kSlopes; ++slope_at) {
    const double slope =
        kFlattest * std::pow(kSteepest / kFlattest, slope_at / (kSlopes - 1.0)) / spread;
    for (int place_at = 0; place_at < kPlaces; ++place_at) {
      const double place = mean + spread * kFarthest * (2.0 * place_at / (kPlaces - 1.0) - 1.0);
      for (std::size_t level = 0; level < levels.size(); ++level) {
        tail[level] = core::standard_normal_cdf(slope * (levels[level].place - place));
      }
      for (std::size_t curve = 0; curve < best.size(); ++curve) {
        for (const double lapse : kLapses) {
          // In yes-no answers lapses occur at both ends.
          const double low = curve == 0 ? lapse : guess_of(curve);
          double value = 0.0;
          for (std::size_t level = 0; level < levels.size() && value > best[curve]; ++level) {
            const double f = low + (1.0 - low - lapse) * tail[level];
            value += log_likelihood(levels[level].yes, levels[level].trials,
                                    std::clamp(f, 1e-9, 1.0 - 1e-9));
          }
          best[curve] = std::max(best[curve], value);
        }
      }
    }
  }
  return best;
}

/// Whether the share of right answers is above one half by more than chance explains
/// (one-sided, 10 %).
bool above_half(double yes, double trials) {
  constexpr double kLevel = 0.1;
  if (yes <= 0.5 * trials) return false;
  return fair_trials_at_least(yes, trials) <= kLevel;
}

}  // namespace

std::optional<double> suspected_chance(const std::vector<AnswerCount>& rows) {
  // The 95 % quantile of chi-squared with one degree of freedom.
  constexpr double kNoise = 3.841458820694124;
  const double kTwentyTimes = std::log(20.0);
  const std::vector<Level> levels = levels_of(rows);
  if (levels.empty()) return std::nullopt;
  double yes = 0.0, trials = 0.0;
  for (const Level& level : levels) {
    yes += level.yes;
    trials += level.trials;
  }
  const bool rests_above_half = above_half(yes, trials);
  std::array<double, 4> best{};
  bool searched = false;
  for (std::size_t place = 0; place < kChances.size(); ++place) {
    const Chance& one = kChances[place];
    if (loss_at_or_above(levels, one.chance) > kNoise) continue;
    if (!searched) best = best_log_likelihoods(levels);
    searched = true;
    const double log_ratio = best[place + 1] - best[0];
    const bool many = rests_above_half && yes >= one.many * trials;
    if (log_ratio >= kTwentyTimes || (many && log_ratio >= one.least_log_ratio)) {
      return one.chance;
    }
  }
  return std::nullopt;
}

std::string chance_warning(double chance) {
  const std::string alternatives = std::to_string(std::lround(1.0 / chance));
  return "no level lies below 1/" + alternatives + ", the chance among " + alternatives +
         " alternatives: if num_yes counts right answers of a forced choice, tell their chance "
         "(--guess 1/2, 1/3, 1/4); fitted as yes and no they give another pse and Weber "
         "fraction";
}

}  // namespace jnd::analysis
