#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

namespace jnd::app {

/// Returns the one JSON document of which the text consists, with a final line end. If there is
/// anything else, the test fails and the result is null.
inline nlohmann::json document(const std::string& text) {
  const nlohmann::json parsed = nlohmann::json::parse(text, nullptr, false);
  EXPECT_FALSE(parsed.is_discarded()) << "expected one JSON document, found:\n" << text;
  EXPECT_EQ(text.find("NaN"), std::string::npos) << text;
  EXPECT_TRUE(text.ends_with("\n")) << text;
  return parsed.is_discarded() ? nlohmann::json() : parsed;
}

inline std::set<std::string> keys(const nlohmann::json& object) {
  std::set<std::string> names;
  for (const auto& [name, value] : object.items()) names.insert(name);
  return names;
}

}  // namespace jnd::app
