#include "app/gui/widget_log.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "support/files.h"
#include "support/temporary_folder.h"

namespace jnd::app::gui {
namespace widget_log_test {

namespace fs = std::filesystem;

Drawn example() {
  Drawn drawn = {.view = "run", .frame = 12};
  drawn.widgets.push_back({.name = "answer_yes",
                           .label = "Say \"thicker\"",
                           .key = "Y",
                           .place = {10, 20, 100, 50},
                           .enabled = false});
  drawn.widgets.push_back({.name = "note", .label = "a\\b\nc\x01", .key = "Ctrl N"});
  drawn.texts = {"größer als “5 µm”", ""};
  return drawn;
}

nlohmann::json read(const fs::path& file) {
  std::ifstream in(file);
  return nlohmann::json::parse(in);
}

TEST(WidgetLog, IsJsonWithPlacesInPixels) {
  const auto json = nlohmann::json::parse(widgets_json(example(), 1.5f));
  EXPECT_EQ(json["view"], "run");
  EXPECT_EQ(json["frame"], 12);
  EXPECT_EQ(json["scale"], 1.5);
  EXPECT_EQ(json["widgets"][0]["name"], "answer_yes");
  EXPECT_EQ(json["widgets"][0]["label"], "Say \"thicker\"");
  EXPECT_EQ(json["widgets"][0]["key"], "Y");
  EXPECT_EQ(json["widgets"][0]["x"], 15);
  EXPECT_EQ(json["widgets"][0]["y"], 30);
  EXPECT_EQ(json["widgets"][0]["width"], 150);
  EXPECT_EQ(json["widgets"][0]["height"], 75);
  EXPECT_EQ(json["widgets"][0]["enabled"], false);
  EXPECT_EQ(json["widgets"][1]["label"], "a\\b\nc\x01");
  EXPECT_EQ(json["texts"][0], "größer als “5 µm”");
  EXPECT_TRUE(nlohmann::json::parse(widgets_json({}, 1))["widgets"].empty());
}

TEST(WidgetLog, WritesAgainOnlyWhatShowsSomethingNew) {
  const test_support::TemporaryFolder temporary;
  const fs::path file = temporary.path() / "widgets.json";
  WidgetLog log(file);
  Drawn drawn = example();
  log.write(drawn, 1);
  EXPECT_EQ(read(file)["frame"], 12);
  drawn.frame = 13;
  log.write(drawn, 1);
  EXPECT_EQ(read(file)["frame"], 12);
  drawn.texts.emplace_back("more");
  log.write(drawn, 1);
  EXPECT_EQ(read(file)["frame"], 13);
  EXPECT_FALSE(fs::exists(temporary.path() / "widgets.json.tmp"));
}

TEST(WidgetLog, KeepsEveryTextThatAnyFrameOfAnyWindowHasShownOnce) {
  const test_support::TemporaryFolder temporary;
  const fs::path file = temporary.path() / "widgets.json";
  WidgetLog log(file);
  Drawn drawn;
  for (const char* text : {"one", "two\nlines", "one", "three"}) {
    drawn.texts = {text};
    log.write(drawn, 1);
  }
  drawn.texts = {"of the participant", "three"};
  log.keep_texts(drawn);
  EXPECT_EQ(test_support::read_file(temporary.path() / "widgets.json.texts"),
            "one\ntwo lines\nthree\nof the participant\n");
}

TEST(WidgetLog, WithoutAFileItDoesNothingAndWithoutAFolderItSaysSo) {
  WidgetLog("").write(example(), 1);
  WidgetLog nowhere("/no/such/folder/widgets.json");
  EXPECT_THROW(nowhere.write(example(), 1), core::Error);
}

}  // namespace widget_log_test
}  // namespace jnd::app::gui
