#include "analysis/data/json_fields.h"

#include <gtest/gtest.h>

namespace jnd::analysis {
namespace json_fields_test {

using nlohmann::json;

TEST(JsonFields, ATextIsInEnglishOrInTheFirstLanguage) {
  const json study = {{"plain", "P"},
                      {"both", {{"de", "D"}, {"en", "E"}}},
                      {"german", {{"de", "D"}}},
                      {"none", json::object()},
                      {"number", 1}};
  EXPECT_EQ(text_at(study, "plain"), "P");
  EXPECT_EQ(text_at(study, "both"), "E");
  EXPECT_EQ(text_at(study, "german"), "D");
  for (const char* key : {"none", "number", "absent"}) EXPECT_EQ(text_at(study, key), "");
}

TEST(JsonFields, ACommentIsNoLanguage) {
  const json study = {{"title", {{"comment", "nobody reads this"}, {"de", "D"}}}};
  EXPECT_EQ(text_at(study, "title"), "D");
}

TEST(JsonFields, WhatIsNoObjectIsAnEmptyOne) {
  EXPECT_EQ(string_at(object_in(R"({"reason": "late"})"), "reason"), "late");
  for (const char* text : {"", "[1]", "{", "null"}) {
    EXPECT_EQ(object_in(text), json::object()) << text;
  }
}

}  // namespace json_fields_test
}  // namespace jnd::analysis
