#include "analysis/words/said.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "analysis/data/stored_studies.h"
#include "analysis/results/number_words.h"

namespace said_test {

using namespace jnd::analysis;

const char* a_little_german(const char* english) {
  const std::string_view text = english;
  if (text == "trial {} of {}") return "von {1} der Durchgang {0}";
  if (text == "sessions") return "Sitzungen";
  if (text == "{} broken") return "{} {} kaputt";
  return english;
}

class Said : public testing::Test {
 protected:
  void TearDown() override { speak({}); }
  static void speak_german() {
    speak({.code = "de", .words = a_little_german, .decimal_comma = true});
  }
};

TEST_F(Said, IsAsWrittenUntilALanguageIsSpoken) {
  EXPECT_EQ(said("trial {} of {}", 2, 7), "trial 2 of 7");
  EXPECT_EQ(number_words(0.5), "0.5000");
  EXPECT_EQ(counted_words(3, "session"), "3 sessions");
  EXPECT_EQ(p_words(0.0), "< 0.001");
  EXPECT_EQ(in_spoken_language({{"de", "Honig"}, {"en", "Honey"}}), "Honey");
}

TEST_F(Said, IsInTheLanguageWithItsNumbersAndTheStudysOwnWords) {
  speak_german();
  EXPECT_EQ(said("trial {} of {}", 2, 7), "von 7 der Durchgang 2");
  EXPECT_EQ(number_words(0.5), "0,5000");
  EXPECT_EQ(counted_words(3, "session"), "3 Sitzungen");
  EXPECT_EQ(p_words(0.0), "< 0,001");
  EXPECT_EQ(between_numbers(), std::string("; "));
  EXPECT_EQ(in_spoken_language({{"de", "Honig"}, {"en", "Honey"}}), "Honig");
  EXPECT_EQ(in_spoken_language({{"en", "Honey"}}), "Honey");
}

TEST_F(Said, StaysEnglishWhereThereIsNoTranslationOrItsHolesDoNotFit) {
  speak_german();
  EXPECT_EQ(said("{} fits", 2), "2 fits");
  EXPECT_EQ(said("{} broken", 2), "2 broken");
}

}  // namespace said_test
