#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "analysis/data/csv_table.h"
#include "analysis/fits/curve_fit.h"
#include "support/places.h"

// Curves of data sets of others against R's glm, psyphy's links and optim:
// data/reference/curves/curves.R. docs/methods/agreement.md tells the table.

namespace jnd::analysis {
namespace curve_reference_test {

CsvTable table_of(const char* name) {
  return CsvTable::read(test_support::source_folder() / "data" / "reference" / "curves" / name);
}

using Groups = std::map<std::pair<std::string, std::string>, std::vector<AnswerCount>>;

Groups answers() {
  const CsvTable table = table_of("answers.csv");
  CsvReader reader(table);
  const std::vector<double> intensity = reader.numbers("intensity");
  const std::vector<double> yes = reader.numbers("num_yes");
  const std::vector<double> trials = reader.numbers("num_trials");
  reader.throw_problems();
  Groups groups;
  for (std::size_t row = 0; row < table.num_rows(); ++row) {
    groups[{table.cell(row, 0), table.cell(row, 1)}].push_back(
        {intensity[row], static_cast<std::int64_t>(yes[row]),
         static_cast<std::int64_t>(trials[row])});
  }
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
  model.falling = cell("falling") == "1";
  return model;
}

TEST(CurveReference, EveryMaximumIsThatOfTheOtherProgramsOrHigher) {
  const Groups groups = answers();
  const CsvTable table = table_of("reference.csv");
  const auto number = [&](std::size_t row, const char* column) {
    return std::stod(table.cell(row, *table.find(column)));
  };
  int num_compared = 0;
  for (std::size_t row = 0; row < table.num_rows(); ++row) {
    std::vector<AnswerCount> rows = groups.at({table.cell(row, 0), table.cell(row, 1)});
    const CurveModel model = model_of(table, row);
    if (model.is_logarithmic()) {
      // The reference leaves out what has no logarithm.
      std::erase_if(rows, [](const AnswerCount& one) { return !(one.intensity > 0.0); });
    }
    std::ostringstream where;
    where << table.name() << " line " << table.line(row);
    const CurveFit fit = fit_curve(rows, {.model = model, .intervals = false});
    if (fit.status != FitStatus::kOk) continue;  // A step: others tell any slope.
    ++num_compared;
    const double peers = number(row, "log_likelihood");
    EXPECT_GT(*fit.log_likelihood, peers - 1e-5 * std::fabs(peers)) << where.str();
    if (*fit.log_likelihood > peers + 1e-6 * std::fabs(peers)) continue;  // Ours is higher.
    // As near as the other's own precision: likelihoods alike to 1e-6 have curves alike.
    EXPECT_NEAR(*fit.scale.value, number(row, "scale"), 1e-2 * number(row, "scale"))
        << where.str();
    if (table.cell(row, *table.find("program")).find("glm") == std::string::npos) continue;
    const double scale = number(row, "scale");
    EXPECT_NEAR(*fit.location.value, number(row, "location"), 1e-5 * scale) << where.str();
    EXPECT_NEAR(*fit.scale.value, scale, 1e-5 * scale) << where.str();
  }
  EXPECT_GT(num_compared, 80);
}

}  // namespace curve_reference_test
}  // namespace jnd::analysis
