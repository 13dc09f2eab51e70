#include "app/operator/study_words.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>

#include "app/operator/session_words.h"
#include "core/safety/fault.h"
#include "core/safety/guard.h"
#include "device/registry/device_registry.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/study/media.h"
#include "support/files.h"
#include "support/places.h"

namespace jnd::app {
namespace study_words_test {

/// Returns the catalogue, with sentences that are broken over lines joined.
std::string catalogue() {
  std::string text =
      test_support::read_file(test_support::source_folder() / "data/languages/jnd.pot");
  const std::string line_end = "\"\n\"";
  for (std::size_t at = text.find(line_end); at != text.npos; at = text.find(line_end, at)) {
    text.erase(at, line_end.size());
  }
  return text;
}

void expect_in_catalogue(const std::string& words) {
  static const std::string kCatalogue = catalogue();
  EXPECT_NE(kCatalogue.find("msgid \"" + words + "\"\n"), std::string::npos)
      << "no translator sees \"" << words << '"';
}

TEST(StudyWords, EveryMediumAndEveryProcedureIsInTheCatalogue) {
  for (const experiments::Medium& medium : experiments::media()) {
    expect_in_catalogue(medium_words(medium.name));
  }
  for (const experiments::Procedure* procedure : experiments::procedures()) {
    expect_in_catalogue(procedure_words(std::string(procedure->name())));
  }
  EXPECT_EQ(medium_words("free_space"), "free space");
  EXPECT_EQ(procedure_words("magnitude_estimation"), "Magnitude estimation");
}

TEST(StudyWords, EverySectionOfResultsIsInTheCatalogue) {
  const std::regex section(R"re(ResultsSection section\{\.name = "([a-z_]+)"\})re");
  const std::regex of_block(R"re(\.block \+ "_([a-z_]+)"\})re");
  int num_sections = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(
           test_support::source_folder() / "analysis")) {
    if (entry.path().extension() != ".cpp") continue;
    const std::string source = test_support::read_file(entry.path());
    for (const bool as_title : {true, false}) {
      const std::regex& names = as_title ? section : of_block;
      for (std::sregex_iterator it(source.begin(), source.end(), names), end; it != end; ++it) {
        expect_in_catalogue(name_words((*it)[1], as_title));
        ++num_sections;
      }
    }
  }
  EXPECT_GE(num_sections, 10);
  for (const experiments::Procedure* procedure : experiments::procedures()) {
    if (!procedure->adapts()) continue;
    expect_in_catalogue(name_words(std::string(procedure->name())));
  }
}

TEST(StudyWords, EveryFaultWarningPointAndDeviceIsInTheCatalogue) {
  for (int code = 1; code <= static_cast<int>(core::kLastFault); ++code) {
    const auto fault = static_cast<core::Fault>(code);
    expect_in_catalogue(std::string(core::words(fault)));
    const std::string warning(core::warning_words(fault));
    if (!warning.empty()) expect_in_catalogue(warning);
  }
  for (int point = 0; point < 5; ++point) {
    expect_in_catalogue(told_points(static_cast<std::uint8_t>(1 << point)));
  }
  for (const device::DeviceEntry& entry : device::devices()) {
    expect_in_catalogue(std::string(entry.description));
  }
}

TEST(StudyWords, PointsAreToldOneAfterTheOther) {
  EXPECT_EQ(told_points(0), "");
  EXPECT_EQ(told_points(8), "the index finger");
  EXPECT_EQ(told_points(9), "the inner palm and the index finger");
  EXPECT_EQ(told_points(31),
            "the inner palm, the outer palm, the thumb, the index finger and "
            "the middle finger");
}

}  // namespace study_words_test
}  // namespace jnd::app
