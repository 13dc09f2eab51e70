#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/data/csv_table.h"
#include "analysis/mixed/mixed_derived.h"
#include "analysis/mixed/mixed_table.h"
#include "support/files.h"
#include "support/places.h"
#include "support/reference_data.h"

// Compares mixed models with lme4's glmer (data/reference/mixed/mixed_reference.R), and PSE and
// JND with those of MixedPsy (data/reference/agreement/mixedpsy.R).

namespace jnd::analysis {
namespace mixed_reference_test {

using Json = nlohmann::json;

std::string text_of(const std::string& name) {
  return test_support::read_file(test_support::source_folder() / "data" / "reference" /
                                 "mixed" / name);
}

/// Builds lme4's data set VerbAgg from its people and its items.
std::string verbagg() {
  const auto table = [](const char* name, const std::vector<std::string>& variables,
                        const char* answers) {
    return parse_trial_table(text_of(name), name,
                             {.answers = {.yes = answers, .yes_value = "x", .trials = {}},
                              .variables = variables,
                              .where = {}});
  };
  const TrialTable people =
      table("verbagg_people.csv", {"id", "Anger", "Gender", "answers"}, "id");
  const TrialTable items = table("verbagg_items.csv", {"item", "btype", "situ"}, "item");
  std::string text = "id,Anger,Gender,item,btype,situ,y\n";
  for (std::size_t person = 0; person < people.num_rows(); ++person) {
    for (std::size_t item = 0; item < items.num_rows(); ++item) {
      for (const char* column : {"id", "Anger", "Gender"}) {
        text += people.find(column)->cell(person) + ",";
      }
      for (const char* column : {"item", "btype", "situ"}) {
        text += items.find(column)->cell(item) + ",";
      }
      text += people.find("answers")->cell(person).substr(item, 1) + "\n";
    }
  }
  return text;
}

MixedFit fit_of(const Json& model) {
  const std::string data = model.at("data"), trials = model.at("trials");
  const MixedFormulas formulas{parse_formula(model.at("fixed")),
                               parse_random_terms(model.at("random"))};
  TrialColumns columns{.answers = {.yes = model.at("yes"), .yes_value = {}, .trials = {}},
                       .variables = columns_of(formulas),
                       .where = {}};
  if (!trials.empty()) columns.answers.trials = trials;
  const TrialTable table =
      parse_trial_table(data == "verbagg" ? verbagg() : text_of(data + ".csv"), data, columns);
  const Contrasts contrasts =
      model.at("contrasts") == "sum" ? Contrasts::kSum : Contrasts::kTreatment;
  return fit_mixed(
      mixed_data(formulas, Design(formulas.fixed, table, contrasts), table, contrasts),
      {.curve = {.link = *mixed_link(model.at("link").get<std::string>()),
                 .guess_rate = model.at("guess"),
                 .lapse_rate = model.at("lapse")},
       .num_nodes = model.at("nodes")});
}

TEST(MixedReference, EveryMaximumIsThatOfLme4OrHigher) {
  int num_alike = 0, num_higher = 0;
  for (const Json& model :
       test_support::reference_data("mixed/mixed_reference.json")["models"]) {
    const std::string where =
        model.at("data").get<std::string>() + " " + model.at("fixed").get<std::string>() + " " +
        model.at("random").get<std::string>() + " " + model.at("link").get<std::string>() +
        " " + std::to_string(model.at("nodes").get<int>());
    const MixedFit fit = fit_of(model);
    ASSERT_EQ(fit.status, FitStatus::kOk) << where << fit.reason;
    const double theirs = model.at("log_likelihood");
    EXPECT_GT(fit.log_likelihood, theirs - 1e-5) << where;
    ASSERT_EQ(fit.fixed.size(), model.at("names").size()) << where;
    for (std::size_t i = 0; i < fit.fixed.size(); ++i) {
      EXPECT_EQ(fit.fixed[i].name, model.at("names")[i]) << where;
    }
    if (fit.log_likelihood > theirs + 1e-5) {
      ++num_higher;
      continue;
    }
    ++num_alike;
    // lme4 does not polish large sets there, and their errors come from its own differences.
    const bool is_large = model.at("data") == "verbagg";
    for (std::size_t i = 0; i < fit.fixed.size(); ++i) {
      const double estimate = model.at("estimates")[i], error = model.at("standard_errors")[i];
      EXPECT_NEAR(fit.fixed[i].estimate, estimate,
                  1e-4 * std::max(std::fabs(estimate), is_large ? 10.0 * error : error))
          << where << " " << fit.fixed[i].name;
      EXPECT_NEAR(fit.fixed[i].standard_error, error, (is_large ? 1e-2 : 1e-3) * error)
          << where << " " << fit.fixed[i].name;
    }
    const Json& random = model.at("random_effects");
    ASSERT_EQ(fit.random.size(), random.size()) << where;
    for (const RandomEffect& one : fit.random) {
      bool is_found = false;
      for (const Json& other : random) {
        // lme4 names the second term of one grouping "participant.1".
        const std::string group = other.at("group");
        if (other.at("name") != one.name || (group != one.group && group != one.group + ".1")) {
          continue;
        }
        is_found = true;
        EXPECT_NEAR(one.sd, other.at("sd").get<double>(), 1e-4 + 1e-3 * one.sd)
            << where << " " << one.name;
        ASSERT_EQ(one.correlations.size(), other.at("correlations").size());
        for (std::size_t i = 0; i < one.correlations.size(); ++i) {
          EXPECT_NEAR(one.correlations[i], other.at("correlations")[i].get<double>(), 2e-3)
              << where << " " << one.name;
        }
      }
      EXPECT_TRUE(is_found) << where << " " << one.group << " " << one.name;
    }
  }
  EXPECT_GE(num_alike + num_higher, 20);
  EXPECT_GE(num_alike, 15);
}

struct PsychophysicalModel {
  std::string study, fixed, random;
};

/// Returns the log-likelihood as "log_likelihood", and the model's PSE and JND.
std::vector<DerivedQuantity> said_of(const PsychophysicalModel& model) {
  const MixedFormulas formulas{parse_formula(model.fixed), parse_random_terms(model.random)};
  const std::string text = test_support::read_file(
      test_support::source_folder() / "data" / "reference" / "agreement" / "mixedpsy_rows.csv");
  const TrialTable table =
      parse_trial_table(text, "mixedpsy_rows.csv",
                        {.answers = {.yes = "num_yes", .yes_value = {}, .trials = "num_trials"},
                         .variables = columns_of(formulas),
                         .where = {{"study", model.study}}});
  const Design design(formulas.fixed, table, Contrasts::kTreatment);
  const MixedFit fit =
      fit_mixed(mixed_data(formulas, design, table, Contrasts::kTreatment), {});
  EXPECT_EQ(fit.status, FitStatus::kOk) << model.study << fit.reason;
  std::vector<DerivedQuantity> said = derived_quantities(
      stimulus_lines(formulas.fixed, design, table, "intensity"), MixedLink::kProbit, 0.75,
      fit.estimates(), {.covariance = fit.fixed_covariance, .redrawn = {}});
  said.push_back({.name = "log_likelihood", .value = fit.log_likelihood});
  return said;
}

TEST(MixedReference, PseAndJndOfMixedPsysExamplesAreThoseOfItsFormulas) {
  std::map<std::string, std::vector<DerivedQuantity>> said;
  for (const PsychophysicalModel& model :
       {PsychophysicalModel{"simul_data", "intensity", "1 | person"},
        PsychophysicalModel{"vibro_exp3", "intensity * vibration", "1 + intensity | person"}}) {
    said[model.study] = said_of(model);
  }
  const CsvTable table = CsvTable::read(test_support::source_folder() / "data" / "reference" /
                                        "agreement" / "mixedpsy.csv");
  for (std::size_t row = 0; row < table.num_rows(); ++row) {
    const std::string& study = table.cell(row, 0);
    const std::string& condition = table.cell(row, 1);
    const std::string& quantity = table.cell(row, 2);
    const double theirs = std::stod(table.cell(row, 3));
    std::string name = quantity == "pse" ? "PSE" : quantity == "jnd" ? "JND" : quantity;
    if (!condition.empty()) name += ", vibration " + condition;
    const std::vector<DerivedQuantity>& ours = said.at(study);
    const auto found = std::ranges::find_if(
        ours, [&](const DerivedQuantity& one) { return one.name == name; });
    ASSERT_NE(found, ours.end()) << study << " " << name;
    if (quantity == "log_likelihood") {
      EXPECT_GT(*found->value, theirs - 1e-7) << study;
      EXPECT_NEAR(*found->value, theirs, 1e-5) << study;
      continue;
    }
    const double error = std::stod(table.cell(row, 4));
    EXPECT_NEAR(*found->value, theirs, 1e-5 * error + 1e-5 * std::fabs(theirs))
        << study << " " << name;
    // glmer's errors come from differences, and the second model is at its bound.
    EXPECT_NEAR(*found->standard_error, error, 5e-3 * error) << study << " " << name;
  }
  EXPECT_EQ(table.num_rows(), 8);
}

}  // namespace mixed_reference_test
}  // namespace jnd::analysis
