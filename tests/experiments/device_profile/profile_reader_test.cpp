#include "experiments/device_profile/profile_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/error.h"
#include "experiments/device_profile/device_profile_table.h"
#include "experiments/device_profile/profile_signature.h"
#include "experiments/device_profile/profile_writer.h"
#include "support/files.h"
#include "support/places.h"
#include "support/sound_profile.h"
#include "support/temporary_folder.h"

namespace jnd::experiments {
namespace profile_reader_test {

namespace fs = std::filesystem;
using nlohmann::json;
using test_support::read_file;
using test_support::sound_profile;

std::string problems_of(const std::string& text) {
  std::string lines;
  for (const StudyProblem& problem : device_profile_text_problems(text, "x.json")) {
    lines += to_string(problem) + '\n';
  }
  return lines;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  return at == text.npos ? text : text.replace(at, from.size(), to);
}

TEST(DeviceProfile, IsReadAsItWasWritten) {
  const DeviceProfile profile = sound_profile();
  const std::string text = device_profile_text(profile);
  EXPECT_EQ(problems_of(text), "");
  EXPECT_EQ(read_device_profile_text(text, "x.json"), profile);
  EXPECT_EQ(device_profile_text(read_device_profile_text(text, "x.json")), text);
}

TEST(DeviceProfile, NumbersComeBackToTheLastBit) {
  DeviceProfile profile = sound_profile();
  const double angle_rad = 0.3;
  profile.frame.rotation = {std::cos(angle_rad),
                            -std::sin(angle_rad),
                            0.0,
                            std::sin(angle_rad),
                            std::cos(angle_rad),
                            0.0,
                            0.0,
                            0.0,
                            1.0};
  profile.frame.offset_m = {0.1 + 0.2, 1.0 / 3.0, -0.71};
  profile.force.gain = MeasuredValue{std::nextafter(1.0, 2.0), {1.0, 1.1}};
  EXPECT_EQ(read_device_profile_text(device_profile_text(profile), "x.json"), profile);
}

TEST(DeviceProfile, LeavesOutWhatWasNotMeasured) {
  DeviceProfile profile;
  const DeviceProfile whole = sound_profile();
  profile.name = "bare";
  profile.device = {.model = "wam"};
  profile.measured_on = whole.measured_on;
  profile.valid_until = whole.valid_until;
  profile.program_version = whole.program_version;
  profile.limits = profile.measured_limits = whole.limits;
  const std::string text = device_profile_text(profile);
  EXPECT_EQ(problems_of(text), "");
  EXPECT_EQ(read_device_profile_text(text, "x.json"), profile);
  for (const char* key : {"force", "tool", "mechanics", "noise", "delay_s", "stability",
                          "checks", "comment", "residual_m"}) {
    EXPECT_EQ(text.find('"' + std::string(key) + '"'), text.npos) << key;
  }
}

// `profile_fields.h` writes the fields and the table describes them: neither has a field that
// the other lacks.
TEST(DeviceProfile, WritesEveryKeyOfTheTablesInTheirOrder) {
  const auto text = nlohmann::ordered_json::parse(device_profile_text(sound_profile()));
  const auto check = [](const nlohmann::ordered_json& object, const ParameterTable& table,
                        const auto& self) -> void {
    std::vector<std::string> written, described;
    for (const auto& [key, value] : object.items()) {
      if (key != "comment") written.push_back(key);
    }
    for (const Parameter& parameter : table.parameters) {
      described.push_back(parameter.key);
      if (parameter.nested == nullptr || !object.contains(parameter.key)) continue;
      const nlohmann::ordered_json& value = object.at(parameter.key);
      self(value.is_array() ? value.at(0) : value, *parameter.nested, self);
    }
    EXPECT_EQ(written, described) << table.name;
  };
  check(text, device_profile_table(), check);
}

TEST(DeviceProfile, TakesACommentInEveryObject) {
  auto text = json::parse(device_profile_text(sound_profile()));
  const auto add = [](json& value, const auto& self) -> void {
    if (value.is_object()) value["comment"] = "looked at";
    if (!value.is_structured()) return;
    for (auto& one : value) self(one, self);
  };
  add(text, add);
  EXPECT_EQ(problems_of(text.dump()), "");
}

TEST(DeviceProfile, MayBeEditedWherePeopleMay) {
  const std::string text = device_profile_text(sound_profile());
  std::string edited = replaced(text, "\"left_arm\"", "\"arm_by_the_door\"");
  edited = replaced(edited, "2999-12-31", "2027-01-31");
  edited = replaced(edited, "\"max_total_force_n\": 30.0", "\"max_total_force_n\": 5");
  edited = replaced(edited, "beside the window", "moved");
  EXPECT_EQ(problems_of(edited), "");
  const DeviceProfile profile = read_device_profile_text(edited, "x.json");
  EXPECT_EQ(profile.limits.max_total_force_n, 5.0);
  EXPECT_FALSE(is_same_measurement(profile, sound_profile())) << "its limits are narrower";
  DeviceProfile same = profile;
  same.limits = sound_profile().limits;
  same.checks.clear();
  EXPECT_TRUE(is_same_measurement(same, sound_profile()));
}

/// Returns a changed value of the same kind, or null if the value is no number and no boolean.
json changed(const json& value) {
  if (value.is_number_integer()) return value.get<int>() + 1;
  if (value.is_number()) return value.get<double>() * 0.999 + 1e-9;
  if (value.is_boolean()) return !value.get<bool>();
  return nullptr;
}

// Whichever measured number is changed, the profile is refused, and the message names the part
// in which the number stands.
TEST(DeviceProfile, IsRefusedWhereAnyMeasuredNumberWasChanged) {
  const auto text = json::parse(device_profile_text(sound_profile()));
  const json flat = text.flatten();
  int num_changed = 0;
  for (const auto& [pointer, value] : flat.items()) {
    const std::string part = pointer.substr(1, pointer.find('/', 1) - 1);
    if (part == "limits" || part == "format" || part == "signature") continue;
    const json other = changed(value);
    if (other.is_null()) continue;
    json edited = text;
    edited[json::json_pointer(pointer)] = other;
    const std::vector<StudyProblem> problems =
        device_profile_text_problems(edited.dump(), "x.json");
    ASSERT_EQ(problems.size(), 1u) << pointer;
    const std::string expected = part == "simulated" ? "/signature/origin" : '/' + part;
    EXPECT_TRUE(problems.front().pointer.starts_with(expected))
        << pointer << ": " << to_string(problems.front());
    ++num_changed;
  }
  EXPECT_GT(num_changed, 50);
}

TEST(DeviceProfile, IsRefusedWhereAPartIsFromAnotherMeasurement) {
  DeviceProfile other = sound_profile();
  other.measured_on = "2026-11-19";
  other.force.gain = MeasuredValue{1.0, {0.99, 1.01}};
  const auto theirs = json::parse(device_profile_text(other));
  auto ours = json::parse(device_profile_text(sound_profile()));
  ours["force"] = theirs["force"];
  ours["signature"]["force"] = theirs["signature"]["force"];
  const auto problems = device_profile_text_problems(ours.dump(), "x.json");
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems.front().pointer, "/force");
}

TEST(DeviceProfile, IsTheSameHoweverNumbersAreWritten) {
  const std::string text = device_profile_text(sound_profile());
  EXPECT_EQ(
      problems_of(replaced(text, "\"phantom_mass_kg\": 0.2", "\"phantom_mass_kg\": 20e-2")),
      "");
  EXPECT_EQ(problems_of(replaced(text, "\"value\": 400.0", "\"value\": 400")), "");
  EXPECT_EQ(problems_of(json::parse(text).dump()), "") << "keys in another order";
}

TEST(DeviceProfile, IsNeverWrittenOverAnother) {
  const test_support::TemporaryFolder folder;
  DeviceProfile profile = sound_profile();
  const fs::path first = write_device_profile(profile, folder.path() / "devices");
  EXPECT_EQ(first.filename(), "left_arm.device.json");
  const std::string text = read_file(first);
  profile.comment = "a second one";
  EXPECT_EQ(write_device_profile(profile, first.parent_path()).filename(),
            "left_arm-2026-11-25.device.json");
  EXPECT_EQ(write_device_profile(profile, first.parent_path()).filename(),
            "left_arm-2026-11-25-2.device.json");
  EXPECT_EQ(read_file(first), text);
  EXPECT_EQ(read_device_profile(first), sound_profile());
  EXPECT_EQ(read_file(first.parent_path() / kDeviceProfileSchemaFileName),
            device_profile_schema());
}

TEST(DeviceProfile, ThatCannotBeWrittenIsToldOf) {
  const test_support::TemporaryFolder folder;
  test_support::write_file(folder.path() / "file", "");
  try {
    write_device_profile(sound_profile(), folder.path() / "file");
    FAIL();
  } catch (const core::Error& error) {
    EXPECT_NE(std::string(error.what()).find("expected to write the device's profile, found: "),
              std::string::npos)
        << error.what();
  }
}

TEST(DeviceProfile, ThatIsNotThereIsOneProblem) {
  EXPECT_EQ(to_string(device_profile_problems("/no/such.device.json").at(0)),
            "/no/such.device.json: expected a device profile that can be read, found no such "
            "file");
  EXPECT_THROW((void)read_device_profile("/no/such.device.json"), ProtocolError);
}

TEST(DeviceProfile, ItsSchemaDescribesEveryKeyAndAllowsNoOther) {
  const json schema = json::parse(device_profile_schema());
  int num_keys = 0;
  for (const ParameterTable* table : device_profile_tables()) {
    const json& own =
        table == &device_profile_table() ? schema : schema.at("definitions").at(table->name);
    EXPECT_EQ(own.at("additionalProperties"), false) << table->name;
    EXPECT_EQ(own.at("properties").size(), table->parameters.size() + 1) << table->name;
    for (const Parameter& parameter : table->parameters) {
      const json& key = own.at("properties").at(parameter.key);
      const auto words = key.at("description").get<std::string>();
      EXPECT_NE(words.find(parameter.meaning), std::string::npos) << parameter.key;
      EXPECT_NE(words.find(parameter.unit), std::string::npos) << parameter.key;
      if (parameter.kind == ValueKind::kMeasured) {
        EXPECT_EQ(key.at("properties").at("value").at("maximum"), parameter.range.high);
        EXPECT_EQ(key.at("properties").at("ci95").at("minItems"), 2);
        EXPECT_EQ(key.at("required"), json::array({"value", "ci95"}));
      }
      ++num_keys;
    }
  }
  EXPECT_GT(num_keys, 60);
}

TEST(DeviceProfile, TheShippedSchemaAndReferenceAreThoseOfTheTables) {
  const auto shipped = [](const std::string& name) {
    return read_file(test_support::source_folder() / "protocols" / name);
  };
  EXPECT_TRUE(shipped(kDeviceProfileSchemaFileName) == device_profile_schema())
      << "renew it: build/jnd schema --device-profile > protocols/"
      << kDeviceProfileSchemaFileName;
  EXPECT_TRUE(shipped("device_profile.md") == device_profile_reference())
      << "renew it: build/jnd schema --device-profile --markdown > protocols/device_profile.md";
}

TEST(DeviceProfile, EveryBrokenOneGivesExactlyTheMessagesBesideIt) {
  const fs::path folder =
      test_support::source_folder() / "tests/experiments/device_profile/broken";
  std::string all;
  int num_files = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!entry.path().filename().string().ends_with(kDeviceProfileEnding)) continue;
    std::string lines;
    for (const StudyProblem& problem : device_profile_text_problems(
             read_file(entry.path()), entry.path().filename().string())) {
      lines += to_string(problem) + '\n';
    }
    fs::path expected = entry.path();
    expected.replace_extension("").replace_extension(".txt");
    EXPECT_NE(lines, "") << entry.path() << " is not broken";
    EXPECT_EQ(lines, read_file(expected)) << entry.path();
    all += lines;
    ++num_files;
  }
  EXPECT_GT(num_files, 20);
  // The broken profiles show every message of the rules.
  const std::string code =
      read_file(test_support::source_folder() / "experiments/device_profile/profile_rules.cpp");
  int num_messages = 0;
  for (std::size_t at = code.find("\"expected "); at != code.npos;
       at = code.find("\"expected ", at + 1)) {
    const std::string words = code.substr(at + 1, code.find('"', at + 1) - at - 1);
    ++num_messages;
    EXPECT_NE(all.find(words), all.npos) << "no profile shows `" << words << "`";
  }
  EXPECT_GE(num_messages, 8);
}

}  // namespace profile_reader_test
}  // namespace jnd::experiments
