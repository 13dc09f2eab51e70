#include "app/results/predictive_studies.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/results/results_output.h"
#include "core/storage/sha256.h"
#include "experiments/protocol/study_reader.h"
#include "support/places.h"
#include "support/sanitizer.h"

namespace jnd::app {
namespace predictive_studies_test {

namespace fs = std::filesystem;

constexpr const char* kRenew =
    "; these are not the people that this program simulates in the shipped laboratory and "
    "study: renew the file as data/predictive/README.md says";

struct Shipped {
  experiments::Study study;
  experiments::Laboratory laboratory;
  std::optional<analysis::PredictivePeople> people;
};
Shipped shipped(const std::string& study, const std::string& laboratory) {
  const fs::path source = test_support::source_folder();
  Shipped found{.study = experiments::read_study(source / "protocols" / (study + ".json")),
                .laboratory = experiments::read_laboratory(source / "data" / "laboratories" /
                                                           (laboratory + ".json"))};
  found.people = shipped_people({.study = found.study.name,
                                 .study_sha256 = core::sha256(found.study.text),
                                 .laboratory = found.laboratory.name,
                                 .laboratory_sha256 = core::sha256(found.laboratory.text),
                                 .device = "lumped"});
  return found;
}

constexpr std::pair<const char*, const char*> kShipped[] = {
    {"magnitude_of_virtual_water", "thesis"}, {"viscosity_discrimination", "thesis"}};

TEST(PredictiveStudies, ShippedPeopleAreThoseOfTheShippedStudiesAndLaboratories) {
  for (const auto& [study, laboratory] : kShipped) {
    const Shipped found = shipped(study, laboratory);
    ASSERT_TRUE(found.people) << study << " in " << laboratory << kRenew;
    for (const auto& group : found.people->groups) {
      EXPECT_EQ(group.size(), 52U) << study << " in " << laboratory;
    }
    EXPECT_GE(found.people->groups.size(), 2U);
  }
}

/// Simulates the first two people of the first two groups again.
TEST(PredictiveStudies, ShippedPeopleAreWhoThisProgramSimulates) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "minutes of the same code";
  for (const auto& [study, laboratory] : kShipped) {
    const Shipped found = shipped(study, laboratory);
    if (!found.people) continue;  // The other test reports this.
    analysis::PredictivePeople again = simulate_people({.study = found.study,
                                                        .laboratory = found.laboratory,
                                                        .num_people = 4,
                                                        .seed = found.people->seed,
                                                        .jobs = 2});
    analysis::PredictivePeople first = *found.people;
    first.groups.resize(2);
    for (auto& group : first.groups) group.resize(2);
    EXPECT_EQ(to_text(again), to_text(first)) << study << " in " << laboratory << kRenew;
  }
}

}  // namespace predictive_studies_test
}  // namespace jnd::app
