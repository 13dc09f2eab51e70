#include "device/network/hmac_sha256.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "support/allocation_counter.h"

namespace jnd::device {
namespace hmac_sha256_test {

HmacKey key_of(std::string_view text) {
  HmacKey key{};
  std::transform(text.begin(), text.end(), key.begin(),
                 [](char letter) { return static_cast<std::byte>(letter); });
  return key;
}

std::string hexadecimal(const HmacCode& code) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const std::byte byte : code) {
    text += kDigits[std::to_integer<std::size_t>(byte >> 4)];
    text += kDigits[std::to_integer<std::size_t>(byte & std::byte{15})];
  }
  return text;
}

std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text));
}

/// These are cases 1 and 2 of RFC 4231. A shorter key is filled up with zeros.
TEST(HmacSha256, GivesTheCodesOfTheStandard) {
  EXPECT_EQ(hexadecimal(hmac_sha256(key_of(std::string(20, 0x0b)), bytes_of("Hi There"))),
            "b0344c61d8db38535ca8afceaf0bf12b881dc200c9833da726e9376c2e32cff7");
  EXPECT_EQ(hexadecimal(hmac_sha256(key_of("Jefe"), bytes_of("what do ya want for nothing?"))),
            "5bdcc146bf60754e6a042426089575c75a003f089d2739839dec58b964ec3843");
}

TEST(HmacSha256, TwoPartsAreOneBehindTheOther) {
  const std::string text(500, 'x');
  const auto bytes = bytes_of(text);
  EXPECT_EQ(hmac_sha256(key_of("k"), bytes.first(77), bytes.subspan(77)),
            hmac_sha256(key_of("k"), bytes));
  EXPECT_NE(hmac_sha256(key_of("k"), bytes), hmac_sha256(key_of("l"), bytes));
}

TEST(HmacSha256, TakesNoMemory) {
  if (!test_support::AllocationCounter::is_supported()) GTEST_SKIP();
  const std::string text(900, 'x');
  const test_support::AllocationCounter counter;
  for (int i = 0; i < 100; ++i) (void)hmac_sha256(key_of("k"), bytes_of(text));
  EXPECT_EQ(counter.allocations(), 0u);
  EXPECT_EQ(counter.frees(), 0u);
}

}  // namespace hmac_sha256_test
}  // namespace jnd::device
