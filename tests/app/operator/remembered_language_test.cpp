#include "app/operator/remembered_language.h"

#include <gtest/gtest.h>

#include "support/files.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace remembered_language_test {

namespace fs = std::filesystem;

TEST(RememberedLanguage, IsTheLastOneThatWasChosen) {
  const test_support::TemporaryFolder temporary;
  const fs::path folder = temporary.path() / "state" / "jnd";
  EXPECT_EQ(remembered_language(folder), "");
  for (const char* code : {"de", "en", "pt_BR", "sr@latin"}) {
    remember_language(folder, code);
    EXPECT_EQ(remembered_language(folder), code);
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1)
      << "nothing lies beside it";
}

TEST(RememberedLanguage, IsNoneWhereTheFileHoldsAnythingElse) {
  const test_support::TemporaryFolder temporary;
  for (const std::string& wrong :
       {std::string(), std::string("\n"), std::string("../../etc"), std::string("de de"),
        std::string("de\0", 3), std::string(33, 'a')}) {
    test_support::write_file(temporary.path() / "language", wrong);
    EXPECT_EQ(remembered_language(temporary.path()), "") << wrong;
  }
  remember_language(temporary.path(), "../x");
  EXPECT_EQ(remembered_language(temporary.path()), "") << "it is no code of a language";
}

TEST(RememberedLanguage, WithoutAFolderIsNotKept) {
  remember_language("", "de");
  EXPECT_EQ(remembered_language(""), "");
  remember_language("/proc/no/such/folder", "de");
  EXPECT_EQ(remembered_language("/proc/no/such/folder"), "");
}

}  // namespace remembered_language_test
}  // namespace jnd::app
