#include "device/network/datagram_seal.h"

#include <algorithm>
#include <array>

#include "device/network/wire_bytes.h"

namespace jnd::device {
namespace {

std::span<const std::byte> bytes_of(std::string_view label) noexcept {
  return std::as_bytes(std::span(label));
}

}  // namespace

void DatagramSeal::begin_stream(std::uint64_t token, std::uint64_t stream_id) noexcept {
  if (!key_) return;
  has_stream_ = true;
  std::array<std::byte, 16> numbers{};
  wire::ByteWriter writer(numbers);
  writer.number(token);
  writer.number(stream_id);
  to_device_ = hmac_sha256(*key_, bytes_of("to device"), numbers);
  to_program_ = hmac_sha256(*key_, bytes_of("to program"), numbers);
}

HmacCode DatagramSeal::code_of(std::span<const std::byte> bytes, Side sender) const noexcept {
  if (!wire::is_of_stream(bytes)) return hmac_sha256(*key_, bytes);
  return hmac_sha256(sender == Side::kProgram ? to_device_ : to_program_, bytes);
}

std::size_t DatagramSeal::write(const wire::Datagram& datagram,
                                std::span<std::byte, kMostBytes> bytes) const noexcept {
  const std::size_t size = wire::encode(datagram, bytes.first<wire::kMaxBytes>());
  if (!key_) return size;
  const HmacCode code = code_of(bytes.first(size), side_);
  std::copy_n(code.begin(), kBytes, bytes.begin() + static_cast<std::ptrdiff_t>(size));
  return size + kBytes;
}

wire::Problem DatagramSeal::read(std::span<const std::byte> bytes,
                                 wire::Datagram& datagram) const noexcept {
  const std::size_t told = wire::size_of(bytes);
  if (!key_) {
    // The datagram is sealed, and this side has no key.
    if (told != 0 && told + kBytes == bytes.size()) return wire::Problem::kOtherKey;
    return wire::decode(bytes, datagram);
  }
  if (told == 0) return wire::decode(bytes, datagram);
  if (told == bytes.size()) return wire::Problem::kOtherKey;
  if (told + kBytes != bytes.size()) return wire::Problem::kWrongSize;
  if (wire::is_of_stream(bytes) && !has_stream_) return wire::Problem::kOtherKey;
  const HmacCode code =
      code_of(bytes.first(told), side_ == Side::kProgram ? Side::kDevice : Side::kProgram);
  if (!is_same_code(std::span(code).first(kBytes), bytes.subspan(told))) {
    return wire::Problem::kOtherKey;
  }
  return wire::decode(bytes.first(told), datagram);
}

}  // namespace jnd::device
