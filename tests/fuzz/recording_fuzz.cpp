#include <zstd.h>

#include <bit>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/storage/sample_codec.h"
#include "fuzz/fuzz_check.h"

namespace {

using namespace jnd;
using core::Sample;

void check_vector(const core::PlainVector& a, const core::PlainVector& b) {
  for (std::size_t axis = 0; axis < a.size(); ++axis) {
    fuzz::property(
        std::bit_cast<std::uint64_t>(a[axis]) == std::bit_cast<std::uint64_t>(b[axis]),
        "a decoded number is stored as it is");
  }
}

void check_same(const Sample& a, const Sample& b) {
  fuzz::property(a.tick == b.tick && a.command_sequence == b.command_sequence &&
                     a.attached_bits == b.attached_bits && a.immersed_bits == b.immersed_bits &&
                     a.limited == b.limited && a.fault == b.fault,
                 "a decoded sample is stored as it is");
  for (std::size_t point = 0; point < a.tip_position_m.size(); ++point) {
    check_vector(a.tip_position_m[point], b.tip_position_m[point]);
    check_vector(a.tip_velocity_m_per_s[point], b.tip_velocity_m_per_s[point]);
    check_vector(a.tip_force_n[point], b.tip_force_n[point]);
  }
  check_vector(a.end_effector_position_m, b.end_effector_position_m);
  for (std::size_t joint = 0; joint < a.joint_position_rad.size(); ++joint) {
    fuzz::property(std::bit_cast<std::uint32_t>(a.joint_position_rad[joint]) ==
                           std::bit_cast<std::uint32_t>(b.joint_position_rad[joint]) &&
                       std::bit_cast<std::uint32_t>(a.joint_torque_n_m[joint]) ==
                           std::bit_cast<std::uint32_t>(b.joint_torque_n_m[joint]),
                   "a decoded joint is stored as it is");
  }
}

/// Expects that decoded samples are the same after they were encoded and decoded again.
void check_chunk(std::string_view bytes, std::int64_t num_samples) {
  try {
    const std::vector<Sample> samples = core::decode_samples(bytes, 1000, num_samples, "chunk");
    fuzz::property(
        static_cast<std::int64_t>(samples.size()) == std::max<std::int64_t>(0, num_samples),
        "as many samples come as were asked for");
    const std::vector<Sample> again =
        core::decode_samples(core::encode_samples(samples), 1000, num_samples, "chunk");
    fuzz::property(again.size() == samples.size(), "as many samples come back");
    for (std::size_t i = 0; i < samples.size(); ++i) check_same(samples[i], again[i]);
  } catch (const core::Error& error) {
    fuzz::check_sentence(error.what());
  }
}

std::string compressed(std::string_view bytes) {
  std::string chunk(ZSTD_compressBound(bytes.size()), '\0');
  chunk.resize(ZSTD_compress(chunk.data(), chunk.size(), bytes.data(), bytes.size(), 1));
  return chunk;
}

}  // namespace

/// The first two bytes say how many samples the row claims, with the lower byte first. The rest
/// is a chunk. Few changed bytes are still zstd, so the same bytes are also taken as the
/// content of a chunk.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  const std::int64_t num_samples = data[0] + 256 * (data[1] % 17) - 1;
  const std::string bytes = fuzz::text_of(data + 2, size - 2);
  check_chunk(bytes, num_samples);
  check_chunk(compressed(bytes), num_samples);
  return 0;
}
