#include "experiments/protocol/label_rules.h"

#include <gtest/gtest.h>

#include "tests/experiments/protocol/broken_study.h"

namespace jnd::experiments {
namespace label_rules_test {

TEST(LabelRules, WantTheTwoAnswersOfABlockToDiffer) {
  const auto labels = [](const std::string& no) {
    return problems_of(broken("\"repetitions\": 5",
                              "\"repetitions\": 5, \"yes_label\": {\"en\": \"Yes\", \"de\": "
                              "\"Ja\"}, \"no_label\": {\"en\": \"" +
                                  no + "\", \"de\": \"Nein\"}"));
  };
  EXPECT_EQ(labels("No"), "");
  EXPECT_EQ(labels("Ja"), "") << "in another language";
  EXPECT_EQ(
      labels("Yes"),
      "x.json:27:87: /stages/2/arms/1/stages/0/no_label/en: expected words of its own, so "
      "that answers can be told apart, found \"Yes\", as in "
      "/stages/2/arms/1/stages/0/yes_label");
}

TEST(LabelRules, WantTheOptionsOfAChoiceToDiffer) {
  EXPECT_EQ(problems_of(broken("\"de\": \"links\"", "\"de\": \"rechts\"")),
            "x.json:38:69: /stages/3/items/1/options/1/label/de: expected words of its own, so "
            "that answers can be told apart, found \"rechts\", as in "
            "/stages/3/items/1/options/0/label");
}

TEST(LabelRules, WantTheEndsOfAScaleToDiffer) {
  EXPECT_EQ(problems_of(broken("{\"en\": \"yes\"", "{\"en\": \"no\"")),
            "x.json:40:71: /stages/3/items/2/high_label/en: expected words of its own, so that "
            "answers can be told apart, found \"no\", as in /stages/3/items/2/low_label");
}

TEST(LabelRules, LetCommentsRepeatThemselves) {
  EXPECT_EQ(
      problems_of(broken("{\"en\": \"right\"", "{\"comment\": \"c\", \"en\": \"right\"",
                         broken("{\"en\": \"left\"", "{\"comment\": \"c\", \"en\": \"left\""))),
      "");
}

}  // namespace label_rules_test
}  // namespace jnd::experiments
