#include "app/session/shipped_files.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "app/tiny_study.h"
#include "core/error.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace shipped_files_test {

namespace fs = std::filesystem;

TEST(Share, FindsShippedStudiesByNameAndByPath) {
  for (const char* name :
       {"short_tour", "short_tour.json", "protocols/short_tour.json", "no/such/short_tour"}) {
    EXPECT_TRUE(fs::equivalent(user_or_shipped(name, "protocols"),
                               test_support::source_folder() / "protocols/short_tour.json"))
        << name;
  }
  EXPECT_TRUE(fs::exists(user_or_shipped("thesis", "data/laboratories")));
}

TEST(Share, TheUsersOwnFileComesFirst) {
  const test_support::TemporaryFolder temporary;
  const fs::path own = write_file(temporary.path() / "short_tour.json", "{}");
  EXPECT_EQ(user_or_shipped(own.string(), "protocols"), own);
}

TEST(Share, WhatIsNowhereKeepsItsNameForTheReaderToComplainAbout) {
  EXPECT_EQ(user_or_shipped("no_such_study.json", "protocols"), "no_such_study.json");
}

TEST(Share, WhatIsNearlyAShippedNameIsToldThatName) {
  try {
    (void)user_or_shipped("short_tou", "protocols");
    ADD_FAILURE() << "taken";
  } catch (const core::Error& error) {
    EXPECT_STREQ(error.what(),
                 "short_tou: expected a file or the name of a shipped one, found "
                 "neither; did you mean `short_tour`?");
  }
  EXPECT_EQ(user_or_shipped("short_tou", "protocols", /*keep_near=*/true), "short_tou");
  EXPECT_EQ(user_or_shipped("folder/short_tou", "protocols"), "folder/short_tou");
}

TEST(Share, AFolderInTheEnvironmentComesBeforeTheRest) {
  const test_support::TemporaryFolder temporary;
  fs::create_directories(temporary.path() / "protocols");
  write_file(temporary.path() / "protocols" / "only_there.json", "{}");
  ::setenv("JND_SHARE", temporary.path().c_str(), 1);
  EXPECT_EQ(shipped_folder(), temporary.path());
  EXPECT_EQ(user_or_shipped("only_there", "protocols"),
            temporary.path() / "protocols" / "only_there.json");
  ::unsetenv("JND_SHARE");
  EXPECT_NE(shipped_folder(), temporary.path());
}

}  // namespace shipped_files_test
}  // namespace jnd::app
