#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

// Takes one input, as libFuzzer gives it, and returns 0. Throws what a reader must not throw,
// and `std::logic_error` for a property that does not hold. Each fuzz target defines this
// function once.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace jnd::fuzz {

inline std::string text_of(const std::uint8_t* data, std::size_t size) {
  std::string text(size, '\0');
  for (std::size_t i = 0; i < size; ++i) text[i] = static_cast<char>(data[i]);
  return text;
}

inline void property(bool holds, std::string_view sentence) {
  if (!holds) throw std::logic_error("property broken: " + std::string(sentence));
}

/// Expects a sentence for a person: UTF-8, on one line, without control characters, and not too
/// long.
inline void check_sentence(const std::string& sentence, std::size_t most_characters = 300) {
  static_cast<void>(nlohmann::json(sentence).dump());  // This throws if the text is not UTF-8.
  std::size_t num_characters = 0;
  for (std::size_t i = 0; i < sentence.size(); ++i) {
    const auto byte = static_cast<unsigned char>(sentence[i]);
    const bool is_high_control =
        byte == 0xC2 && static_cast<unsigned char>(sentence[i + 1]) < 0xA0;
    property(byte >= 0x20 && byte != 0x7F && !is_high_control,
             "a message has no control characters");
    if ((byte & 0xC0) != 0x80) ++num_characters;
  }
  property(num_characters > 0 && num_characters <= most_characters,
           "a message is of moderate length: " + sentence.substr(0, 400));
}

/// Expects a message with one problem on each of its lines.
inline void check_lines(const std::string& message) {
  std::istringstream lines(message);
  for (std::string line; std::getline(lines, line);) check_sentence(line);
}

}  // namespace jnd::fuzz
