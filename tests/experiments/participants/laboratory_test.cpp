#include "experiments/participants/laboratory.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "core/error.h"
#include "support/files.h"
#include "support/places.h"

namespace jnd::experiments {
namespace laboratory_test {

std::string shipped(const char* name) {
  return test_support::read_file(test_support::source_folder() / "data/laboratories" / name);
}

nlohmann::json thesis() { return nlohmann::json::parse(shipped("thesis.json")); }

std::string problems_of(const nlohmann::json& file) {
  try {
    (void)parse_laboratory(file.dump(), "x.json");
  } catch (const core::Error& error) {
    return error.what();
  }
  return "";
}

TEST(Laboratory, EveryShippedOneIsReadWithItsText) {
  for (const char* name : {"thesis.json", "misspecified.json"}) {
    const std::string text = shipped(name);
    const Laboratory laboratory = parse_laboratory(text, name);
    EXPECT_EQ(laboratory.text, text);
    EXPECT_EQ(laboratory.name + ".json", name);
    EXPECT_GT(laboratory.device.mass_kg, 0.0);
    EXPECT_GT(laboratory.perceiver.weber_fraction, 0.0);
    EXPECT_GT(laboratory.movement.max_speed_m_per_s, 0.0);
    EXPECT_TRUE(laboratory.strokes.contains("default"));
  }
}

TEST(Laboratory, ANumberStandsAloneOrWithItsBasis) {
  nlohmann::json file = thesis();
  file["device"]["mass_kg"] = 3.5;
  EXPECT_EQ(parse_laboratory(file.dump(), "x.json").device.mass_kg, 3.5);
  file["device"]["mass_kg"] = {{"value", 4.5}, {"basis", "assumption"}};
  EXPECT_EQ(parse_laboratory(file.dump(), "x.json").device.mass_kg, 4.5);
  file["device"]["mass_kg"] = {{"value", 4.5}, {"basis", "hearsay"}};
  EXPECT_NE(problems_of(file).find("/device/mass_kg/basis: expected thesis"),
            std::string::npos);
}

TEST(Laboratory, TellsEveryProblemAtOnce) {
  nlohmann::json file = thesis();
  file["device"].erase("dry_friction_n");
  file["device"]["mass_kg"] = "heavy";
  file["perceiver"]["lapse_rate"] = 0.7;
  file["perceiver"]["noise"] = "loud";
  file["perceiver"]["wisdom"] = 1;
  file["extra"] = 1;
  file["format"] = 2;
  const std::string problems = problems_of(file);
  for (const char* expected :
       {"x.json: 7 problem(s)",
        "/device/dry_friction_n: expected a number from 0 to 1e+09, found none",
        "/device/mass_kg: expected a number", "found \"heavy\"",
        "/perceiver/lapse_rate: expected a number from 0 to 0.499, found 0.7",
        "/perceiver/noise: expected one of normal, weibull, found \"loud\"",
        "/perceiver/wisdom: unknown key", "/extra: unknown key", "/format: expected 1"}) {
    EXPECT_NE(problems.find(expected), std::string::npos) << expected << "\nin " << problems;
  }
}

TEST(Laboratory, EveryNumberIsNeededAndMustBeOne) {
  const nlohmann::json file = thesis();
  for (const char* section : {"device", "arm", "movement", "perceiver"}) {
    for (const auto& [key, value] : file[section].items()) {
      if (key == "comment") continue;
      nlohmann::json without = file;
      without[section].erase(key);
      const std::string place = std::string("/") + section + "/" + key + ": expected";
      // Older laboratories do not have this key.
      const bool is_optional = key == "free_modulus";
      EXPECT_TRUE(is_optional || problems_of(without).find(place) != std::string::npos)
          << place;
      nlohmann::json text = file;
      text[section][key] = "x";
      EXPECT_NE(problems_of(text).find(place), std::string::npos) << place;
    }
    nlohmann::json gone = file;
    gone.erase(section);
    EXPECT_NE(problems_of(gone).find(std::string("/") + section + ": expected an object"),
              std::string::npos);
  }
}

TEST(Laboratory, WhatIsNoObjectIsToldSo) {
  for (const char* text : {"", "[]", "{", "7", "\xff"}) {
    EXPECT_THROW((void)parse_laboratory(text, "x.json"), core::Error) << text;
  }
  EXPECT_THROW((void)read_laboratory("/none/there.json"), core::Error);
}

TEST(Laboratory, APartOfAnotherTypeIsAProblemAndNoFault) {
  for (const char* key : {"name", "title", "calibrated_on", "device", "arm", "movement",
                          "strokes", "perceiver"}) {
    for (const nlohmann::json& wrong :
         {nlohmann::json(7), nlohmann::json("x"), nlohmann::json::array({1, 2}),
          nlohmann::json(nullptr)}) {
      nlohmann::json file = thesis();
      if (wrong.is_string() && (std::string(key) == "name" || std::string(key) == "title"))
        continue;
      file[key] = wrong;
      EXPECT_THROW((void)parse_laboratory(file.dump(), "x.json"), core::Error) << key << wrong;
    }
  }
}

TEST(Laboratory, AProcedureWithoutStrokesOfItsOwnHasTheDefault) {
  const Laboratory laboratory = parse_laboratory(shipped("thesis.json"), "thesis.json");
  EXPECT_EQ(&laboratory.strokes_for("yet_unheard_of"), &laboratory.strokes.at("default"));
  EXPECT_EQ(&laboratory.strokes_for("constant_stimuli"),
            &laboratory.strokes.at("constant_stimuli"));
}

TEST(Laboratory, TellsOfAnyJunkInShortLinesForATerminal) {
  nlohmann::json file = thesis();
  file[std::string("\x1B[2J\n") + std::string(100000, 'k')] = 1;
  file["device"][std::string(100000, 'k')] = 1;
  file["device"]["mass_kg"] = {{"value", std::string(100000, 'v')}, {"why\x1B", 0}};
  file["perceiver"]["noise"] = std::vector<int>(100000, 1);
  file["strokes"]["a/b\x1B"] = nullptr;
  std::istringstream lines(problems_of(file));
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LT(line.size(), 300u) << line.substr(0, 400);
    EXPECT_EQ(line.find('\x1B'), std::string::npos) << line;
  }
}

TEST(Laboratory, ShowsAValueOfBottomlessNestingWithoutRunningOutOfStack) {
  const std::string text = R"({"device": {"mass_kg": {"value": )" + std::string(1000000, '[') +
                           std::string(1000000, ']') + "}}}";
  EXPECT_THROW((void)parse_laboratory(text, "x.json"), core::Error);
}

TEST(Laboratory, ReadsAProcedureWhoseNameHoldsASlash) {
  nlohmann::json file = thesis();
  file["strokes"]["a/b"] = file["strokes"]["default"];
  EXPECT_TRUE(parse_laboratory(file.dump(), "x.json").strokes.contains("a/b"));
}

TEST(Laboratory, LooksBehindAZeroByte) {
  EXPECT_THROW((void)parse_laboratory(shipped("thesis.json") + '\0' + "junk", "x.json"),
               core::Error);
}

}  // namespace laboratory_test
}  // namespace jnd::experiments
