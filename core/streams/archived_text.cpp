#include "core/streams/archived_text.h"

#include <cmath>
#include <cstdint>
#include <cstring>

#include "core/error.h"
#include "core/streams/xml_element.h"

namespace jnd::core {
namespace {

/// Thrown and caught in this file: more bytes have to come.
struct StillToCome {};

class ArchiveReader {
 public:
  explicit ArchiveReader(std::string_view bytes) : bytes_(bytes) {}

  std::string_view take(std::size_t size) {
    if (bytes_.size() - at_ < size) throw StillToCome{};
    at_ += size;
    return bytes_.substr(at_ - size, size);
  }

  std::uint64_t number() {
    const auto size = static_cast<unsigned char>(take(1)[0]);
    if (size > 8) {
      throw Error("stream: expected a number of at most 8 bytes, found one of " +
                  std::to_string(size));
    }
    std::uint64_t value = 0;
    const std::string_view raw = take(size);
    for (std::size_t i = 0; i < raw.size(); ++i) {
      value |= std::uint64_t{static_cast<unsigned char>(raw[i])} << (8 * i);
    }
    return value;
  }

  std::string text(std::size_t most) {
    const std::uint64_t size = number();
    if (size > most) {
      throw Error("stream: expected texts of at most " + std::to_string(most) +
                  " bytes, found one of " + std::to_string(size));
    }
    return std::string(take(static_cast<std::size_t>(size)));
  }

  [[nodiscard]] std::size_t num_read() const noexcept { return at_; }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

}  // namespace

std::optional<ArchivedHeader> take_archived_header(std::string_view bytes) try {
  constexpr unsigned char kMark = 127;
  ArchiveReader reader(bytes);
  if (static_cast<unsigned char>(reader.take(1)[0]) != kMark) {
    throw Error("stream: expected a feed of protocol 1.00, found another beginning");
  }
  (void)reader.number();  // The version of the layout.
  ArchivedHeader header{.xml = reader.text(kMostXmlBytes)};
  // Before the first sample, the version of the samples' layout comes twice.
  (void)reader.number();
  (void)reader.number();
  header.num_bytes = reader.num_read();
  return header;
} catch (const StillToCome&) {
  return std::nullopt;
}

std::optional<TakenSample> take_archived_sample(std::string_view bytes, int channel_count) try {
  ArchiveReader reader(bytes);
  TakenSample taken;
  const std::uint64_t mark = reader.number();
  if (mark != 1 && mark != 2) {
    throw Error("stream: expected a sample with a mark of 1 or 2, found " +
                std::to_string(mark));
  }
  taken.has_time = mark == 2;
  if (taken.has_time) {
    const std::uint64_t bits = reader.number();
    std::memcpy(&taken.sample.time_s, &bits, sizeof bits);
    if (!std::isfinite(taken.sample.time_s)) {
      throw Error("stream: expected a sample with a time, found one that is no number");
    }
  }
  for (int channel = 0; channel < channel_count; ++channel) {
    taken.sample.texts.push_back(reader.text(kMostTextBytes));
  }
  taken.num_bytes = reader.num_read();
  return taken;
} catch (const StillToCome&) {
  return std::nullopt;
}

}  // namespace jnd::core
