#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "analysis/data/csv_table.h"
#include "analysis/fits/curve_comparison.h"
#include "analysis/fits/curve_fit.h"
#include "support/places.h"

// Compares curves of other people's data sets with R's glm, psyphy's links and optim
// (data/reference/curves/curves.R), and with what psignifit, Palamedes, quickpsy and psyphy
// printed themselves (data/reference/agreement). The tables are explained in
// docs/methods/agreement.md.

namespace jnd::analysis {
namespace curve_reference_test {

CsvTable table_of(const char* folder, const char* name) {
  return CsvTable::read(test_support::source_folder() / "data" / "reference" / folder / name);
}

using Groups = std::map<std::pair<std::string, std::string>, std::vector<AnswerCount>>;

void add_answers(const char* folder, Groups& groups) {
  const CsvTable table = table_of(folder, "answers.csv");
  CsvReader reader(table);
  const std::vector<double> intensity = reader.numbers("intensity");
  const std::vector<double> yes = reader.numbers("num_yes");
  const std::vector<double> trials = reader.numbers("num_trials");
  reader.throw_problems();
  for (std::size_t row = 0; row < table.num_rows(); ++row) {
    groups[{table.cell(row, 0), table.cell(row, 1)}].push_back(
        {intensity[row], static_cast<std::int64_t>(yes[row]),
         static_cast<std::int64_t>(trials[row])});
  }
}

/// Returns the answers of both folders.
Groups answers() {
  Groups groups;
  add_answers("curves", groups);
  add_answers("agreement", groups);
  return groups;
}

CurveModel model_of(const CsvTable& table, std::size_t row) {
  const auto cell = [&](const char* column) { return table.cell(row, *table.find(column)); };
  CurveModel model;
  for (const CurveFamilyTraits& one : curve_families()) {
    if (one.name == cell("family")) model.family = one.family;
  }
  model.log_axis = cell("axis") == "log";
  model.free_guess = cell("guess") == "free";
  if (!model.free_guess) model.guess_rate = std::stod(cell("guess"));
  model.free_lapse = cell("lapse") == "free";
  if (!model.free_lapse) model.lapse_rate = std::stod(cell("lapse"));
  if (table.find("falling")) model.falling = cell("falling") == "1";
  if (table.find("symmetric")) model.symmetric = cell("symmetric") == "1";
  return model;
}

/// Leaves out intensities that have no logarithm if the curve is logarithmic, as the references
/// do.
std::vector<AnswerCount> rows_for(const CurveModel& model, std::vector<AnswerCount> rows) {
  if (model.is_logarithmic()) {
    std::erase_if(rows, [](const AnswerCount& one) { return !(one.intensity > 0.0); });
  }
  return rows;
}

TEST(CurveReference, EveryMaximumIsThatOfTheOtherProgramsOrHigher) {
  const Groups groups = answers();
  const CsvTable table = table_of("curves", "reference.csv");
  const auto number = [&](std::size_t row, const char* column) {
    return std::stod(table.cell(row, *table.find(column)));
  };
  int num_compared = 0;
  for (std::size_t row = 0; row < table.num_rows(); ++row) {
    const CurveModel model = model_of(table, row);
    const std::vector<AnswerCount> rows =
        rows_for(model, groups.at({table.cell(row, 0), table.cell(row, 1)}));
    std::ostringstream where;
    where << table.name() << " line " << table.line(row);
    const CurveFit fit = fit_curve(rows, {.model = model, .intervals = false});
    // The best curve is a step, for which other programs report any slope.
    if (fit.status != FitStatus::kOk) continue;
    ++num_compared;
    const double peers = number(row, "log_likelihood");
    EXPECT_GT(*fit.log_likelihood, peers - 1e-5 * std::fabs(peers)) << where.str();
    // Our likelihood is higher.
    if (*fit.log_likelihood > peers + 1e-6 * std::fabs(peers)) continue;
    // The tolerance is the other program's own precision: likelihoods that agree to 1e-6 belong
    // to curves that agree so far.
    EXPECT_NEAR(*fit.scale.value, number(row, "scale"), 1e-2 * number(row, "scale"))
        << where.str();
    if (table.cell(row, *table.find("program")).find("glm") == std::string::npos) continue;
    const double scale = number(row, "scale");
    EXPECT_NEAR(*fit.location.value, number(row, "location"), 1e-5 * scale) << where.str();
    EXPECT_NEAR(*fit.scale.value, scale, 1e-5 * scale) << where.str();
  }
  EXPECT_GT(num_compared, 80);
}

/// Returns a cell of compared.csv, or nothing if the other program printed none.
std::optional<double> printed(const CsvTable& table, std::size_t row, const char* column) {
  const std::string& cell = table.cell(row, *table.find(column));
  return cell.empty() ? std::nullopt : std::optional(std::stod(cell));
}

TEST(CurveReference, NumbersThatOtherProgramsPrintedAreNoLikelierThanOurs) {
  const Groups groups = answers();
  const CsvTable table = table_of("agreement", "compared.csv");
  std::map<std::string, int> num_compared;
  for (std::size_t row = 0; row < table.num_rows(); ++row) {
    const CurveModel model = model_of(table, row);
    const std::string& data_set = table.cell(row, 0);
    const std::string& group = table.cell(row, 1);
    const std::string& program = table.cell(row, *table.find("program"));
    std::ostringstream where;
    where << table.name() << " line " << table.line(row) << ", " << data_set << " " << group;
    const CurveFit fit = fit_curve(rows_for(model, groups.at({data_set, group})),
                                   {.model = model, .intervals = false});
    if (fit.status != FitStatus::kOk) {
      // The best curve is a step. The priors of psignifit keep its slope finite, and the other
      // programs stop at a steep one.
      EXPECT_TRUE(group == "test_2AFC_logistic" || group == "Square 2 Downward" ||
                  data_set == "modelfree Schofield_etal")
          << where.str() << ": " << fit.reason;
      continue;
    }
    ++num_compared[program];
    const double scale = *fit.scale.value;
    const double near = *fit.log_likelihood;
    // R found the maximum of the same model.
    EXPECT_NEAR(near, *printed(table, row, "r_log_likelihood"), 1e-8 * std::fabs(near))
        << where.str();
    EXPECT_NEAR(*fit.location.value, *printed(table, row, "r_location"), 1e-5 * scale)
        << where.str();
    EXPECT_NEAR(scale, *printed(table, row, "r_scale"), 1e-5 * scale) << where.str();
    EXPECT_NEAR(*fit.guess_rate.value, *printed(table, row, "r_guess_rate"), 1e-5)
        << where.str();
    EXPECT_NEAR(*fit.lapse_rate.value, *printed(table, row, "r_lapse_rate"), 1e-5)
        << where.str();
    // The other program's maximum may be of the likelihood alone or of the likelihood with its
    // priors.
    const std::optional<double> theirs = printed(table, row, "log_likelihood");
    if (theirs) {
      EXPECT_GT(near, *theirs - 1e-9 * std::fabs(near)) << where.str();
    }
    if (program == "Palamedes") {
      EXPECT_NEAR(*fit.location.value, *printed(table, row, "location"), 1e-7 * scale)
          << where.str();
      EXPECT_NEAR(scale, *printed(table, row, "scale"), 1e-7 * scale) << where.str();
    }
  }
  EXPECT_EQ(num_compared["Palamedes"], 40);
  EXPECT_EQ(num_compared["psignifit 4 (MATLAB)"], 20);
  EXPECT_GT(num_compared["psignifit 2.5.6"], 90);
  EXPECT_GT(num_compared["psyphy 0.2.3"], 10);
}

TEST(CurveReference, ModelsThatShareASlopeAreAsLikelyAsQuickpsySays) {
  // The page dlinares.org/model_selection.html prints three digits, and its likelihoods contain
  // binomial coefficients.
  struct Printed {
    const char* participant;
    double log_likelihood, aic;
  };
  const Groups groups = answers();
  for (const Printed& one :
       {Printed{"Participant1", -44.8, 95.6}, Printed{"Participant2", -26.5, 59.0},
        Printed{"Participant3", -23.0, 52.0}}) {
    std::vector<ComparedGroup> conditions;
    double coefficients = 0.0;
    for (const char* condition : {" cond1", " cond2"}) {
      const std::string name = std::string(one.participant) + condition;
      conditions.push_back({name, groups.at({"quickpsy qpdat", name})});
      for (const AnswerCount& row : conditions.back().rows) {
        const auto yes = static_cast<double>(row.num_yes);
        const auto trials = static_cast<double>(row.num_trials);
        coefficients += std::lgamma(trials + 1.0) - std::lgamma(yes + 1.0) -
                        std::lgamma(trials - yes + 1.0);
      }
    }
    const CurveComparison found = compare_curves(conditions, {});
    bool is_there = false;
    for (const ComparedModel& model : found.models) {
      if (model.name != "different location, same scale") continue;
      is_there = true;
      const double log_likelihood = *model.log_likelihood + coefficients;
      EXPECT_NEAR(log_likelihood, one.log_likelihood, 0.05) << one.participant;
      EXPECT_NEAR(2.0 * model.num_parameters - 2.0 * log_likelihood, one.aic, 0.05)
          << one.participant;
    }
    EXPECT_TRUE(is_there) << one.participant;
  }
}

}  // namespace curve_reference_test
}  // namespace jnd::analysis
