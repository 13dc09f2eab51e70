#include "app/operator/file_excerpt.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/operator/simulated_study.h"
#include "app/operator/study_cards.h"
#include "app/operator/study_folder.h"
#include "app/operator/study_outline.h"

namespace jnd::app {
namespace file_excerpt_test {

namespace fs = std::filesystem;
using testing::ElementsAre;

TEST(FileExcerpt, IsTheLineWithTwoOnEitherSide) {
  const std::vector<std::string> lines = {"a", "bé: 1", "c", "d", "e", "f"};
  const FileExcerpt middle = excerpt_at(lines, 2, 3);
  ASSERT_EQ(middle.lines.size(), 4U);
  EXPECT_EQ(middle.lines[0].number, 1);
  EXPECT_TRUE(middle.lines[1].is_meant);
  EXPECT_EQ(middle.lines[1].before, "bé") << "columns are characters, not bytes";
  EXPECT_EQ(middle.lines[3].text, "d");
  EXPECT_EQ(excerpt_at(lines, 6, 1).lines.size(), 3U);
  EXPECT_EQ(excerpt_at(lines, 6, 1).lines.back().before, "");
  EXPECT_EQ(excerpt_at(lines, 6, 0).lines.back().before, "f") << "the line as a whole";
  EXPECT_TRUE(excerpt_at(lines, 0, 0).lines.empty());
  EXPECT_TRUE(excerpt_at(lines, 7, 1).lines.empty());
}

TEST(FileExcerpt, ALongLineIsCutAroundWhatIsMeant) {
  const std::string line = std::string(300, 'x') + "HERE" + std::string(300, 'y');
  const FileExcerpt excerpt = excerpt_at({line}, 1, 301);
  ASSERT_EQ(excerpt.lines.size(), 1U);
  const std::string& text = excerpt.lines[0].text;
  EXPECT_LT(text.size(), 130U);
  EXPECT_EQ(text.substr(excerpt.lines[0].before.size(), 4), "HERE");
  EXPECT_TRUE(text.starts_with("…"));
  EXPECT_TRUE(text.ends_with("…"));
}

TEST(FileExcerpt, AProblemOfAStudyStandsInItsText) {
  const SimulatedStudy made;
  const fs::path wrong =
      write_file(made.temporary() / "wrong.json",
                 replaced(kTinyStudy, R"("repetitions": 2)", R"("repetitions": -2)"));
  const StudyOutline outline = read_outline(wrong);
  ASSERT_EQ(outline.problems.size(), 1U);
  ASSERT_EQ(outline.excerpts.size(), 1U);
  bool found = false;
  for (const FileExcerpt::Line& line : outline.excerpts[0].lines) {
    if (!line.is_meant) continue;
    found = true;
    EXPECT_EQ(line.number, outline.problems[0].line);
    EXPECT_NE(line.text.find("-2"), std::string::npos) << line.text;
  }
  EXPECT_TRUE(found);
}

TEST(FileExcerpt, OfAStudyWhoseTextIsHiddenThereIsNone) {
  const SimulatedStudy made;
  const fs::path wrong =
      write_file(made.temporary() / "wrong.json",
                 replaced(kTinyStudy, R"("repetitions": 2)", R"("repetitions": -2)"));
  const StudyWatch watch(wrong, /*shows_levels=*/false, /*shows_text=*/false);
  ASSERT_EQ(watch.outline().excerpts.size(), 1U);
  EXPECT_TRUE(watch.outline().excerpts[0].lines.empty());
}

TEST(StudyCards, EveryShippedStudySaysWhatItIsForAndHowLongItTakes) {
  const std::vector<StudyCard> cards = shipped_study_cards();
  ASSERT_GT(cards.size(), 10U);
  EXPECT_EQ(cards.front().name, "short_tour");
  int num_cited = 0;
  for (const StudyCard& card : cards) {
    EXPECT_NE(card.title, "") << card.name;
    EXPECT_NE(card.purpose, "") << card.name;
    EXPECT_NE(card.length.find("trial"), std::string::npos) << card.name;
    EXPECT_EQ(card.num_problems, 0) << card.name;
    EXPECT_FALSE(card.is_draft);
    num_cited += card.citation.empty() ? 0 : 1;
  }
  EXPECT_GT(num_cited, 2);
}

TEST(StudyCards, DraftsAreFilesThatAreStillThereWithTheirProblems) {
  const SimulatedStudy made;
  const fs::path wrong = write_file(made.temporary() / "wrong.json", "{}");
  create_study_folder(made.file(), made.folder());
  const std::vector<StudyCard> cards =
      draft_cards({{.path = made.file(), .exists = true},
                   {.path = made.folder(), .exists = true},
                   {.path = wrong, .exists = true},
                   {.path = made.temporary() / "gone.json", .exists = false}});
  ASSERT_EQ(cards.size(), 2U);
  EXPECT_EQ(cards[0].title, "Tiny");
  EXPECT_EQ(cards[0].name, made.file().string());
  EXPECT_TRUE(cards[0].is_draft);
  EXPECT_EQ(cards[1].title, "wrong.json");
  EXPECT_GT(cards[1].num_problems, 0);
}

}  // namespace file_excerpt_test
}  // namespace jnd::app
