#include "experiments/protocol/reference_writer.h"

#include <gtest/gtest.h>

#include <sstream>

#include "experiments/protocol/block_examples.h"
#include "experiments/protocol/study_table.h"
#include "experiments/study/parameter_table.h"

namespace jnd::experiments {
namespace reference_writer_test {

/// Returns the lines of the section under a heading, up to the next heading.
std::string section_of(const std::string& heading) {
  static const std::string kText = study_reference();
  std::istringstream lines(kText);
  std::string found;
  bool is_inside = false;
  bool is_code = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) is_code = !is_code;
    if (!is_code && line.starts_with("#")) {
      is_inside = line.substr(line.find_first_not_of('#') + 1) == heading;
    } else if (is_inside) {
      found += line + '\n';
    }
  }
  return found;
}

TEST(ReferenceWriter, HasARowOfSixCellsForEveryKeyOfEveryTable) {
  for (const ParameterTable* table : all_tables()) {
    std::string sections = section_of(table->name);
    if (const Parameter* procedure = table->find("procedure")) {
      for (const std::string& name : procedure->allowed) sections += section_of(name);
    }
    for (const Parameter& parameter : table->parameters) {
      const std::size_t at = sections.find("\n| `" + parameter.key + "` |");
      ASSERT_NE(at, sections.npos) << table->name << ": " << parameter.key;
      const std::string line = sections.substr(at + 1, sections.find('\n', at + 1) - at - 1);
      EXPECT_EQ(std::count(line.begin(), line.end(), '|'), 7) << line;
      EXPECT_NE(line.find(parameter.meaning), line.npos) << line;
    }
  }
}

TEST(ReferenceWriter, TellsUnitRangeAndDefault) {
  const std::string device = section_of("device");
  EXPECT_NE(device.find("| `rate_hz` | number | Hz | >= 100, <= 10000 | `1000` |"), device.npos)
      << device;
  EXPECT_NE(device.find("| `immersion` | object: [immersion](#immersion) | | | optional |"),
            device.npos)
      << device;
  EXPECT_NE(
      section_of("break").find("| `duration_s` | number | s | >= 0, <= 7200 | required |"),
      std::string::npos);
}

TEST(ReferenceWriter, PutsTheKeysAndDataOfAProcedureUnderItsName) {
  const std::string production = section_of("magnitude_production");
  EXPECT_NE(production.find("| `target_percent` |"), production.npos) << production;
  EXPECT_NE(production.find("| trials.csv | `starting_intensity` |"), production.npos);
  EXPECT_EQ(production.find("reference"), production.npos);
  EXPECT_EQ(section_of("block").find("| `target_percent` |"), std::string::npos);
  EXPECT_NE(section_of("block").find("| trials.csv | `response_time_s` | s |"),
            std::string::npos);
}

TEST(ReferenceWriter, HasAnExampleOfEveryStageKindAndProcedure) {
  for (const ParameterTable* stage : stage_tables()) {
    const Parameter* procedure = stage->find("procedure");
    if (procedure == nullptr) {
      EXPECT_NE(section_of(stage->name).find("```json"), std::string::npos) << stage->name;
      continue;
    }
    for (const std::string& name : procedure->allowed) {
      EXPECT_NE(section_of(name).find("\"procedure\": \"" + name + "\""), std::string::npos)
          << name << ": add an example to experiments/protocol/block_examples.cpp";
    }
  }
}

TEST(ReferenceWriter, LinksOnlyToSectionsThatExist) {
  const std::string text = study_reference();
  int num_links = 0;
  for (std::size_t at = text.find("](#"); at != text.npos; at = text.find("](#", at + 1)) {
    const std::string name = text.substr(at + 3, text.find(')', at) - at - 3);
    EXPECT_NE(section_of(name), "") << name;
    ++num_links;
  }
  EXPECT_GT(num_links, 20);
}

}  // namespace reference_writer_test
}  // namespace jnd::experiments
