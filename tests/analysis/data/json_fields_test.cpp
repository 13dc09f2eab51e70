#include "analysis/data/json_fields.h"

#include <gtest/gtest.h>

namespace jnd::analysis {
namespace json_fields_test {

using nlohmann::json;

TEST(JsonFields, WhatIsNoObjectIsAnEmptyOne) {
  EXPECT_EQ(string_at(object_in(R"({"reason": "late"})"), "reason"), "late");
  for (const char* text : {"", "[1]", "{", "null"}) {
    EXPECT_EQ(object_in(text), json::object()) << text;
  }
}

}  // namespace json_fields_test
}  // namespace jnd::analysis
