// Measures how precisely a Weber fraction is known after a number of trials, by constant
// stimuli, staircases and QUEST+ on the same simulated people. `./dev precision` writes
// data/reference/precision. The same seed gives the same files.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "analysis/fits/psychometric_fit.h"
#include "analysis/report/figure_files.h"
#include "analysis/report/run_tool.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/psychometric_function.h"
#include "core/random_stream.h"
#include "experiments/order/counterbalance.h"
#include "experiments/participants/answer_simulator.h"
#include "experiments/participants/laboratory.h"
#include "experiments/procedures/adaptive_trial.h"
#include "experiments/procedures/quest_plus_procedure.h"
#include "experiments/procedures/staircase_procedure.h"
#include "experiments/protocol/study_reader.h"
#include "support/places.h"

namespace {

using namespace jnd::experiments;
using namespace jnd::analysis;

constexpr std::uint64_t kSeed = 2018;
constexpr double kReference = 8.0;
constexpr double kLeastFraction = 0.05, kLargestFraction = 2.0;
constexpr int kMaxTrials = 120, kStep = 10;

/// A study with three ways to ask the same people, 120 trials each.
const char* const kStudy = R"json({
  "format": 1, "name": "precision", "languages": ["en"], "title": {"en": "Precision"},
  "authors": ["jnd"], "stages": [
  {"kind": "block", "name": "constant", "procedure": "constant_stimuli", "medium": "viscous",
   "reference_viscosity_pa_s": 8, "repetitions": 12,
   "viscosity_pa_s": [4, 4.8, 5.6, 6.4, 7.2, 8.9, 10, 11.4, 13.3, 16],
   "instruction": {"en": "Compare."}, "question": {"en": "Thicker?"}, "expected_trial_s": 10},
  {"kind": "block", "name": "stairs", "procedure": "staircase", "medium": "viscous",
   "reference_viscosity_pa_s": 8, "start_viscosity_pa_s": [16, 11],
   "lowest_viscosity_pa_s": 1, "highest_viscosity_pa_s": 64, "step_ratio": [1.3, 1.15, 1.08],
   "num_up": 1, "num_down": 2, "max_reversals": 100, "max_trials": 60,
   "num_reversals_averaged": 100,
   "instruction": {"en": "Compare."}, "question": {"en": "Thicker?"}, "expected_trial_s": 10},
  {"kind": "block", "name": "quest", "procedure": "quest_plus", "medium": "viscous",
   "viscosity_pa_s": [4, 4.8, 5.6, 6.4, 7.2, 8, 8.9, 10, 11.4, 13.3, 16],
   "reference_viscosity_pa_s": 8, "pse_viscosity_pa_s": [5, 12.8],
   "weber_fraction": [0.05, 2], "grid_values": 30, "max_trials": 120,
   "instruction": {"en": "Compare."}, "question": {"en": "Thicker?"}, "expected_trial_s": 10}
  ]})json";

/// The estimators after n trials; their names are columns.
const std::vector<std::pair<std::string, std::string>> kEstimators = {
    {"constant_stimuli", "constant stimuli, curve fitted"},
    {"staircase", "staircase, reversals averaged"},
    {"staircase_fit", "staircase, curve fitted"},
    {"quest_plus", "QUEST+, posterior mean"}};

double ln_within(double fraction) {
  return std::log(std::clamp(fraction, kLeastFraction, kLargestFraction));
}

/// Returns ln w of the curve through the answers, or, if there is none, the end of the range at
/// which its limit lies.
double fitted(const std::vector<LevelAnswer>& answers) {
  std::map<double, AnswerCount> levels;
  for (const LevelAnswer& answer : answers) {
    AnswerCount& row = levels[answer.level];
    row.intensity = answer.level;
    row.num_yes += answer.yes ? 1 : 0;
    ++row.num_trials;
  }
  std::vector<AnswerCount> rows;
  for (const auto& [level, row] : levels) rows.push_back(row);
  const PsychometricFit fit = fit_psychometric(rows, {.reference = kReference,
                                                      .free_pse = true,
                                                      .intervals = false,
                                                      .solver = Solver::kNewton});
  if (fit.weber_fraction) return ln_within(*fit.weber_fraction);
  return ln_within(fit.reason.starts_with("separated") ? 0.0 : 1e300);
}

/// Returns ln w from the mean of the reversals, without those of the first steps, and the level
/// to which the rule converges. The pse is taken to be at the reference.
double by_reversals(const Block& block, const std::vector<AnsweredTrial>& answered) {
  constexpr std::size_t kCoarseSteps = 2;
  double sum_ln = 0.0;
  double count = 0.0;
  double target = 0.5;
  for (int series = 1; series <= 2; ++series) {
    const Staircase staircase(staircase_rule_of(block, series));
    target = staircase.target_probability();
    const StaircaseState state = staircase.after(level_answers(answered, series));
    for (std::size_t i = kCoarseSteps; i < state.reversals.size(); ++i) {
      sum_ln += std::log(state.reversals[i].level / kReference);
      ++count;
    }
  }
  if (count == 0.0) return ln_within(1e300);
  const double spread_ln = sum_ln / count / jnd::core::standard_normal_quantile(target);
  return ln_within(spread_ln > 0.0 ? std::expm1(spread_ln) : 0.0);
}

/// The errors of ln w of one person, by estimator and number of trials.
using Errors = std::vector<std::vector<double>>;

const AnsweredBlock& named(const std::vector<AnsweredBlock>& blocks, const std::string& name) {
  for (const AnsweredBlock& block : blocks) {
    if (block.stage->name == name) return block;
  }
  throw jnd::core::Error("no block " + name);
}

Errors errors_of(const std::vector<AnsweredBlock>& blocks, const QuestPlus& quest,
                 double weber_fraction) {
  const AnsweredBlock& constant = named(blocks, "constant");
  const AnsweredBlock& stairs = named(blocks, "stairs");
  const std::vector<LevelAnswer> asked = level_answers(named(blocks, "quest").trials);
  const Block& staircase = std::get<Block>(stairs.stage->content);
  QuestPlusPosterior posterior = quest.prior();
  Errors errors(kEstimators.size());
  const double truth = std::log(weber_fraction);
  for (int n = kStep; n <= kMaxTrials; n += kStep) {
    const auto first = [n](const auto& all) {
      return std::vector(all.begin(),
                         all.begin() + std::min<std::ptrdiff_t>(n, std::ssize(all)));
    };
    const std::vector<AnsweredTrial> climbed = first(stairs.trials);
    quest.bring_up_to_date(posterior, first(asked));
    const double posterior_mean = quest.estimates(posterior)[1].mean;
    errors[0].push_back(fitted(level_answers(first(constant.trials))) - truth);
    errors[1].push_back(by_reversals(staircase, climbed) - truth);
    errors[2].push_back(fitted(level_answers(climbed)) - truth);
    errors[3].push_back(ln_within(posterior_mean) - truth);
  }
  return errors;
}

/// Returns people who compare steadily. Only their noise, lapses and, if requested, their pse
/// differ.
Laboratory steady_people(Laboratory laboratory, double pse_sd_ln) {
  laboratory.device.mechanical_viscosity_n_s_per_m = 0.0;
  Laboratory::Perceiver& perceiver = laboratory.perceiver;
  perceiver.weber_fraction = 0.3;
  perceiver.weber_fraction_sd_ln = 0.25;
  perceiver.criterion_sd_ln = pse_sd_ln;
  perceiver.criterion_drift_per_trial_ln = 0.0;
  perceiver.lapse_rate = 0.01;
  perceiver.learning_ratio = perceiver.fatigue_ratio_per_trial = 0.0;
  perceiver.look_again_probability = 0.0;
  return laboratory;
}

struct Precision {
  double root_mean_square = 0.0, mean = 0.0;
};

/// Precisions by estimator and number of trials.
using Table = std::vector<std::vector<Precision>>;

Table precision_of(const Study& study, const Laboratory& laboratory, int num_people) {
  const AnswerSimulator simulator(study, laboratory);
  const std::vector<StageInstance> stages = stages_of(study, cells_of(study).front());
  const QuestPlus quest(quest_plus_rule_of(std::get<Block>(study.stages[2].content)));
  std::vector<Errors> people(static_cast<std::size_t>(num_people));
  jnd::core::for_each_index(people.size(), 2, [&](std::size_t i) {
    const std::uint64_t seed =
        jnd::core::derived_seed(kSeed, "precision", {static_cast<std::int64_t>(i)});
    const double truth = draw_person(laboratory, seed).weber_fraction;
    people[i] = errors_of(simulator.answers(stages, seed), quest, truth);
  });
  Table table(kEstimators.size(), std::vector<Precision>(kMaxTrials / kStep));
  for (std::size_t estimator = 0; estimator < table.size(); ++estimator) {
    for (std::size_t n = 0; n < table[estimator].size(); ++n) {
      double sum = 0.0;
      double squares = 0.0;
      for (const Errors& errors : people) {
        sum += errors[estimator][n];
        squares += errors[estimator][n] * errors[estimator][n];
      }
      table[estimator][n] = {std::sqrt(squares / num_people), sum / num_people};
    }
  }
  return table;
}

const std::vector<std::pair<double, std::string>> kPanels = {
    {0.0, "pse at the reference"}, {0.15, "pse differs by 0.15 in ln"}};

Figure figure_of(const std::vector<Table>& tables) {
  FigureTable data{
      .name = "precision",
      .columns = {"pse_sd_ln", "estimator", "num_trials", "root_mean_square_error_ln",
                  "mean_error_ln", "panel", "series"}};
  std::string plot =
      "  set multiplot layout 1,2\n  set logscale y\n  set xrange [0:125]\n"
      "  set yrange [0.05:2.2]\n  set ytics (0.1, 0.2, 0.4, 0.8, 1.6)\n"
      "  set xlabel 'Trials'\n  set ylabel 'Root mean square error of ln w'\n";
  for (std::size_t panel = 0; panel < tables.size(); ++panel) {
    plot += "  set title '" + kPanels[panel].second + "'\n" +
            (panel == 0 ? "  set key bottom left Left reverse samplen 2\n" : "  unset key\n") +
            "  plot ";
    for (std::size_t estimator = 0; estimator < kEstimators.size(); ++estimator) {
      const auto series = static_cast<int>(panel * kEstimators.size() + estimator) + 1;
      for (std::size_t n = 0; n < tables[panel][estimator].size(); ++n) {
        const Precision& one = tables[panel][estimator][n];
        data.rows.push_back({kPanels[panel].first, kEstimators[estimator].first,
                             static_cast<double>(kStep * (n + 1)), one.root_mean_square,
                             one.mean, static_cast<double>(panel + 1), series});
      }
      plot +=
          std::string(estimator > 0 ? ", " : "") +
          "'precision.csv' using 'num_trials':(column('series')==" + std::to_string(series) +
          " ? column('root_mean_square_error_ln') : NaN) with linespoints lt " +
          std::to_string(estimator + 1) + " lw 1.6 ps 0.5 title '" +
          kEstimators[estimator].second + "'";
    }
    plot += "\n";
  }
  plot += "  unset multiplot\n";
  return {.name = "precision",
          .section = "",
          .title = "Precision of a Weber fraction against the number of trials",
          .width_in = 8.0,
          .height_in = 3.6,
          .plot = plot,
          .tables = {std::move(data)}};
}

void write_page(std::ofstream& page, const std::vector<Table>& tables, int num_people) {
  page << "# What trials are worth\n\nWritten by `./dev precision " << num_people << "`; seed "
       << kSeed << ". " << num_people
       << R"( simulated people compare viscosities with 8 Pa s, each in all three
procedures: Weber fractions about 0.3 (0.25 in ln between people), 1 % lapses, no learning and no fatigue. Answers are
those of `experiments/participants/answer_simulator`, so without a device.

- **Constant stimuli**: ten levels from 4 to 16 Pa s in random order; a cumulative Gauss in ln intensity with a free
  pse, maximum likelihood.
- **Staircase**: 1 up, 2 down, two interleaved; the mean of all reversals but the first two of each, brought to w by the
  70.7 % that the rule converges to, the pse taken to be at the reference; and the same curve as above fitted to its
  raw answers.
- **QUEST+**: 30 by 30 grid of pse and w, eleven stimuli; posterior mean of ln w.

Numbers are root mean square errors of ln w: 0.2 is about 20 %. Estimates beyond 0.05 and 2, the ends of the grid of
QUEST+, count as these ends; so do answers without a curve, and staircases that have not turned three times count as
the upper one. The file [precision.csv](precision.csv) has mean errors besides. A staircase of reversals alone cannot
tell a shifted pse from a difference: where people's pse lies off the reference, fit the raw answers.

![Precision against trials](precision.svg)
)";
  for (std::size_t panel = 0; panel < tables.size(); ++panel) {
    page << "\n## "
         << (panel == 0 ? "Everybody's pse at the reference"
                        : "The pse of people differs by 0.15 in ln")
         << "\n\n| trials |";
    for (const auto& [name, words] : kEstimators) page << ' ' << words << " |";
    page << "\n| --- |";
    for (std::size_t i = 0; i < kEstimators.size(); ++i) page << " --- |";
    page << '\n';
    for (int n = 0; n < kMaxTrials / kStep; ++n) {
      page << "| " << kStep * (n + 1) << " |";
      for (const std::vector<Precision>& estimator : tables[panel]) {
        char cell[16];
        std::snprintf(cell, sizeof cell, " %.2f |",
                      estimator[static_cast<std::size_t>(n)].root_mean_square);
        page << cell;
      }
      page << '\n';
    }
  }
}

int run(const std::filesystem::path& folder, int num_people) {
  const Study study = read_study_text(kStudy, "precision.json");
  const Laboratory laboratory = read_laboratory(jnd::test_support::source_folder() / "data" /
                                                "laboratories" / "thesis.json");
  std::vector<Table> tables;
  for (const auto& [pse_sd_ln, words] : kPanels) {
    tables.push_back(precision_of(study, steady_people(laboratory, pse_sd_ln), num_people));
  }
  std::filesystem::create_directories(folder);
  const Figure figure = figure_of(tables);
  const std::vector<DrawnFigure> drawn =
      write_figures({figure}, folder, {.simulated = true, .gnuplot = find_tool({"gnuplot"})});
  if (!drawn.front().problem.empty()) {
    std::fprintf(stderr, "precision: %s\n", drawn.front().problem.c_str());
  }
  std::ofstream page(folder / "README.md");
  write_page(page, tables, num_people);
  page.close();
  return page ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) try {
  const int num_people = argc > 2 ? std::atoi(argv[2]) : 500;
  if (argc < 2 || num_people < 1) {
    std::fprintf(stderr, "usage: jnd_precision FOLDER [PEOPLE]\n");
    return 2;
  }
  return run(argv[1], num_people);
} catch (const jnd::core::Error& error) {
  std::fprintf(stderr, "precision: %s\n", error.what());
  return 1;
}
