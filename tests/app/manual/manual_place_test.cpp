#include "app/manual/manual_place.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "support/files.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace manual_place_test {

namespace fs = std::filesystem;

void put(const fs::path& file) {
  fs::create_directories(file.parent_path());
  test_support::write_file(file, "x");
}

/// Makes a prefix in which the program is installed, and a source tree.
class ManualPlaceTest : public ::testing::Test {
 protected:
  fs::path shipped() const { return temporary_.path() / "share" / "jnd"; }
  fs::path documents() const { return temporary_.path() / "share" / "doc" / "jnd"; }
  fs::path tree() const { return temporary_.path() / "tree"; }

  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
};

TEST_F(ManualPlaceTest, TheInstalledSiteComesFirstThenTheInstalledMarkdown) {
  put(documents() / "docs/how-to/run_a_session.md");
  ManualPlace place = manual_place(shipped(), "docs/how-to/run_a_session.md");
  EXPECT_EQ(place.file, documents() / "docs/how-to/run_a_session.md");
  EXPECT_FALSE(place.is_site);
  put(documents() / "html/docs/how-to/run_a_session.html");
  place = manual_place(shipped(), "docs/how-to/run_a_session.md");
  EXPECT_EQ(place.file, documents() / "html/docs/how-to/run_a_session.html");
  EXPECT_TRUE(place.is_site);
  EXPECT_EQ(place.page, "docs/how-to/run_a_session.md");
}

TEST_F(ManualPlaceTest, ATreeHasItsSiteOnceItIsBuiltAndItsMarkdownBefore) {
  put(tree() / "docs/README.md");
  EXPECT_EQ(manual_place(tree(), "docs/README.md").file, tree() / "docs/README.md");
  // mkdocs makes index.html from a README.
  put(tree() / "build/docs/docs/index.html");
  EXPECT_EQ(manual_place(tree(), "docs/README.md").file, tree() / "build/docs/docs/index.html");
  // A page that is newer than the site is shown as Markdown.
  put(tree() / "docs/how-to/new.md");
  EXPECT_EQ(manual_place(tree(), "docs/how-to/new.md").file, tree() / "docs/how-to/new.md");
}

TEST_F(ManualPlaceTest, WhatIsNowhereHasNoFile) {
  put(tree() / "docs/README.md");
  EXPECT_EQ(manual_place(tree(), "docs/none.md").file, "");
  EXPECT_TRUE(manual_pages(shipped()).empty());
}

TEST_F(ManualPlaceTest, APageIsFoundByItsNameOrItsPath) {
  for (const char* page : {"README.md", "SAFETY.md", "docs/README.md", "docs/site/mkdocs.yml",
                           "docs/how-to/run_a_session.md", "protocols/README.md"}) {
    put(tree() / page);
  }
  const auto pages = manual_pages(tree());
  EXPECT_EQ(pages.size(), 5u) << "all but what is no page";
  EXPECT_EQ(manual_page_named(pages, "run_a_session"), "docs/how-to/run_a_session.md");
  EXPECT_EQ(manual_page_named(pages, "run_a_session.md"), "docs/how-to/run_a_session.md");
  EXPECT_EQ(manual_page_named(pages, "safety"), "SAFETY.md");
  EXPECT_EQ(manual_page_named(pages, "protocols/README.md"), "protocols/README.md");
  EXPECT_EQ(manual_page_named(pages, "readme"), "README.md") << "the shortest path";
  EXPECT_EQ(manual_page_named(pages, "run"), "");
  EXPECT_EQ(manual_page_named(pages, ""), "");
}

// Every screen has to name a page. The names stand in the sources of the screens.
TEST(ScreenPages, EachIsAPageOfTheSitesNavigation) {
  const fs::path root = test_support::source_folder();
  const std::string navigation = test_support::read_file(root / "docs/site/mkdocs.yml");
  const std::string kFunction = "manual_page() const noexcept override {";
  int num_screens = 0;
  for (const auto& entry : fs::directory_iterator(root / "app/gui/application")) {
    const std::string text = test_support::read_file(entry.path());
    std::size_t at = text.find(kFunction);
    if (at == std::string::npos) continue;
    ++num_screens;
    const std::size_t end = text.find('}', at);
    while ((at = text.find('"', at)) < end) {
      const std::size_t close = text.find('"', at + 1);
      const std::string page = text.substr(at + 1, close - at - 1);
      EXPECT_TRUE(fs::exists(root / page)) << entry.path() << ' ' << page;
      EXPECT_NE(navigation.find(": " + page + "\n"), std::string::npos) << page;
      at = close + 1;
    }
  }
  EXPECT_GE(num_screens, 10);
}

}  // namespace manual_place_test
}  // namespace jnd::app
