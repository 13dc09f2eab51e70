#include "device/network/hmac_sha256.h"

#include <openssl/crypto.h>
#include <openssl/sha.h>

namespace jnd::device {
namespace {

// OpenSSL's newer interface, with its HMAC and its digests, allocates memory for each message,
// which the loop must not do. The older one does not, and remains available in OpenSSL 3.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"

class Digest {
 public:
  Digest() noexcept { SHA256_Init(&context_); }
  void add(std::span<const std::byte> bytes) noexcept {
    SHA256_Update(&context_, bytes.data(), bytes.size());
  }
  [[nodiscard]] HmacCode finish() noexcept {
    HmacCode code{};
    SHA256_Final(reinterpret_cast<unsigned char*>(code.data()), &context_);
    return code;
  }

 private:
  SHA256_CTX context_{};
};

#pragma GCC diagnostic pop

}  // namespace

HmacCode hmac_sha256(const HmacKey& key, std::span<const std::byte> first,
                     std::span<const std::byte> second) noexcept {
  constexpr std::size_t kBlock = 64;
  std::array<std::byte, kBlock> inner, outer;
  inner.fill(std::byte{0x36});
  outer.fill(std::byte{0x5c});
  for (std::size_t i = 0; i < key.size(); ++i) {
    inner[i] ^= key[i];
    outer[i] ^= key[i];
  }
  Digest message;
  message.add(inner);
  message.add(first);
  message.add(second);
  const HmacCode digest = message.finish();
  Digest whole;
  whole.add(outer);
  whole.add(digest);
  return whole.finish();
}

bool is_same_code(std::span<const std::byte> a, std::span<const std::byte> b) noexcept {
  return a.size() == b.size() && CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0;
}

}  // namespace jnd::device
