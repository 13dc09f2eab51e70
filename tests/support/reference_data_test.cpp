#include "support/reference_data.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

namespace jnd::test_support {
namespace reference_data_test {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(ReferenceData, ADocumentIsReadOnceAndStays) {
  const nlohmann::json& first = reference_data("thresholds/thresholds.json");
  EXPECT_FALSE(first.at("detection").empty());
  (void)reference_data("fits_reference.json");
  EXPECT_EQ(&reference_data("thresholds/thresholds.json"), &first);
}

TEST(ReferenceData, WhatIsMissingOrNoJsonIsNamed) {
  EXPECT_THAT([] { (void)reference_data("no_such_file.json"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("no_such_file.json")));
  EXPECT_THAT([] { (void)reference_data("fits_reference.py"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("fits_reference.py")));
}

}  // namespace reference_data_test
}  // namespace jnd::test_support
