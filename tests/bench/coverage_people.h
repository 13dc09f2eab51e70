#pragma once

// People with known Weber fractions, and how often an interval contained the truth.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "analysis/fits/psychometric_fit.h"
#include "analysis/fits/sigmoid.h"
#include "core/parallel.h"
#include "core/random_stream.h"

namespace jnd::coverage {

using namespace jnd::analysis;
using core::RandomStream;

/// Stimuli about a reference, those of group D and E of `viscosity_discrimination`.
struct Levels {
  std::string words;
  double reference = 0.0;
  std::vector<double> intensities;
};
inline const Levels kHardLevels = {
    "hard", 1.853, {1.093, 1.237, 1.646, 1.7495, 2.203, 2.553, 3.185, 3.883}};
inline const Levels kEasyLevels = {
    "easy", 16.06, {10.1, 11.58, 13.83, 14.945, 17.505, 18.95, 23.2, 29.335}};

/// A person: z = slope (ln(x / reference) - place), with additional effects that no fit knows.
struct Person {
  double slope = 1.0, place = 0.0, drift = 0.0, lapse = 0.0;
  Sigmoid sigmoid = Sigmoid::kNormal;

  /// `time` goes from -0.5 at the first trial to 0.5 at the last.
  [[nodiscard]] double probability(double log_ratio, double time) const {
    const double z = slope * (log_ratio - place - drift * time);
    return lapse + (1.0 - 2.0 * lapse) * sigmoid_tails(sigmoid, z).lower;
  }
};

/// The population from which people are drawn.
struct Population {
  std::string words;
  double weber_fraction = 0.7;  ///< Weber fraction of the median person.
  double spread_ln = 0.0;       ///< Sd of ln ln(1 + w).
  double place_sd_ln = 0.0;
  double drift_ln = 0.0, lapse = 0.0;
  Sigmoid sigmoid = Sigmoid::kNormal;
  /// The true value is the Weber fraction of a curve that is symmetric in ln: half the distance
  /// between 15.87 and 84.13 %. With normal noise it is w itself.
  bool even_truth = false;

  [[nodiscard]] Person person(double slope_z, double place_z) const {
    return {sigmoid_jnd(sigmoid) / std::log1p(weber_fraction) * std::exp(spread_ln * slope_z),
            place_sd_ln * place_z, drift_ln, lapse, sigmoid};
  }
  [[nodiscard]] double truth() const {
    if (!even_truth) return weber_fraction;
    constexpr double kUpper = 0.84134474606854293;
    const double distance =
        sigmoid_quantile(sigmoid, kUpper) - sigmoid_quantile(sigmoid, 1.0 - kUpper);
    return std::expm1(std::log1p(weber_fraction) * 0.5 * distance / sigmoid_jnd(sigmoid));
  }
};

inline std::vector<AnswerCount> answers_of(const Person& person, const Levels& levels,
                                           int num_trials, RandomStream& random) {
  std::vector<AnswerCount> rows;
  for (const double x : levels.intensities) {
    AnswerCount row{.intensity = x, .num_trials = num_trials};
    for (int trial = 0; trial < num_trials; ++trial) {
      const double time = (trial + 0.5) / num_trials - 0.5;
      row.num_yes +=
          random.with_probability(person.probability(std::log(x / levels.reference), time)) ? 1
                                                                                            : 0;
    }
    rows.push_back(row);
  }
  return rows;
}

/// Returns ln ln(1 + w) of one person, from the person's own fit about the reference of
/// `kHardLevels`. If there is no fit, half an answer is added.
[[nodiscard]] std::optional<double> own_number(const std::vector<AnswerCount>& rows);

/// How often an interval contained the truth. An open end contains everything on its side.
struct Coverage {
  int num_sets = 0, num_without = 0, num_held = 0;

  void add(bool exists, const Interval& interval, double truth) {
    ++num_sets;
    if (!exists || (!interval.low && !interval.high)) {
      ++num_without;
      return;
    }
    num_held +=
        interval.low.value_or(-1e300) <= truth && truth <= interval.high.value_or(1e300);
  }
  [[nodiscard]] std::string words() const {
    const int with = num_sets - num_without;
    if (with == 0) return "-";
    char text[64];
    std::snprintf(text, sizeof text, "%.1f %%", 100.0 * num_held / with);
    return text;
  }
};

inline std::string row_of(const std::vector<std::string>& cells) {
  std::string row;
  for (const std::string& cell : cells) row += "| " + cell + " ";
  return row + "|\n";
}
inline void print_row(const std::vector<std::string>& cells) {
  std::fputs(row_of(cells).c_str(), stdout);
}

/// Each row draws its sets from a stream of its own, so all processors can work at once. Rows
/// are printed in order. stderr says how many are done.
inline void print_rows(const std::vector<std::function<std::string()>>& rows) {
  std::vector<std::string> done(rows.size());
  std::atomic<int> num_done{0};
  const int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  core::for_each_index(rows.size(), jobs, [&](std::size_t i) {
    done[i] = rows[i]();
    std::fprintf(stderr, "coverage: %d of %zu rows of this table\n", ++num_done, rows.size());
  });
  for (const std::string& row : done) std::fputs(row.c_str(), stdout);
  std::fflush(stdout);
}

inline std::string percent(double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%+.1f %%", 100.0 * value);
  return text;
}

/// These functions print Markdown sections to stdout.
void cover_curves(int num_sets, std::uint64_t seed);
void cover_groups(int num_sets, std::uint64_t seed);
void cover_contrasts(int num_sets, std::uint64_t seed);
void cover_difference(int num_sets, std::uint64_t seed);
void cover_mixed_models(int num_sets, std::uint64_t seed);
void cover_power_laws(int num_sets, std::uint64_t seed);
void cover_sequential(int num_sets, std::uint64_t seed);
void cover_robust(int num_sets, std::uint64_t seed);

}  // namespace jnd::coverage
