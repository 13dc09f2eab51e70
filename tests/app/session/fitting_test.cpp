#include "app/session/fitting.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace jnd::app {
namespace fitting_test {

using Fitting = std::map<std::string, std::string>;

TEST(Fitting, IsALineOfPairs) {
  const Fitting fitting = fitting_in(" glove = M,thumb=thin pad ,", "here");
  EXPECT_EQ(fitting, (Fitting{{"glove", "M"}, {"thumb", "thin pad"}}));
  EXPECT_EQ(fitting_line(fitting), "glove=M, thumb=thin pad");
  EXPECT_EQ(fitting_in(fitting_line(fitting), "here"), fitting);
  EXPECT_TRUE(fitting_in("", "here").empty());
  EXPECT_TRUE(fitting_in(" , ", "here").empty());
}

TEST(Fitting, WhatIsNoPairOrTwiceThereIsRefused) {
  for (const char* line : {"glove", "glove=", "=M", "Glove=M", "a=1, a=2", "a b=1"}) {
    EXPECT_THROW((void)fitting_in(line, "here"), core::Error) << line;
  }
}

}  // namespace fitting_test
}  // namespace jnd::app
