#include "core/random_stream.h"

#include <cmath>
#include <numbers>

namespace jnd::core {
namespace {

/// The finaliser of SplitMix64, a bijection that scatters neighbouring values.
std::uint64_t scattered(std::uint64_t value) noexcept {
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9ULL;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebULL;
  return value ^ (value >> 31);
}

constexpr std::uint64_t kGoldenGamma = 0x9e3779b97f4a7c15ULL;

}  // namespace

std::uint64_t derived_seed(std::uint64_t seed, std::string_view purpose,
                           std::initializer_list<std::int64_t> indices) noexcept {
  std::uint64_t hash = scattered(seed + kGoldenGamma);
  for (const char letter : purpose) {
    hash = scattered(hash + kGoldenGamma + static_cast<unsigned char>(letter));
  }
  // The length keeps the keys ("ab", 1) and ("a", 'b', 1) apart.
  hash = scattered(hash ^ purpose.size());
  for (const std::int64_t index : indices) {
    hash = scattered(hash + kGoldenGamma + static_cast<std::uint64_t>(index));
  }
  return hash;
}

RandomStream::RandomStream(std::uint64_t seed, std::string_view purpose,
                           std::initializer_list<std::int64_t> indices) noexcept
    : state_(derived_seed(seed, purpose, indices)) {}

std::uint64_t RandomStream::next_bits() noexcept {
  state_ += kGoldenGamma;
  return scattered(state_);
}

double RandomStream::uniform() noexcept {
  return static_cast<double>(next_bits() >> 11) * 0x1.0p-53;
}

double RandomStream::uniform(double low, double high) noexcept {
  return low + (high - low) * uniform();
}

double RandomStream::normal() noexcept {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

double RandomStream::normal(double mean, double standard_deviation) noexcept {
  return mean + standard_deviation * normal();
}

std::uint64_t RandomStream::below(std::uint64_t num_values) noexcept {
  // Values of the incomplete last block are rejected, so that every result is equally likely.
  const std::uint64_t rejected_below = (0 - num_values) % num_values;
  while (true) {
    const std::uint64_t bits = next_bits();
    if (bits >= rejected_below) return bits % num_values;
  }
}

bool RandomStream::with_probability(double probability) noexcept {
  return uniform() < probability;
}

}  // namespace jnd::core
