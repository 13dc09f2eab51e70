#include "core/streams/stream_messages.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <vector>

#include "core/error.h"

namespace jnd::core {
namespace {

constexpr std::string_view kSearch = "LSL:shortinfo";
constexpr std::string_view kFullInfo = "LSL:fullinfo";
constexpr std::string_view kFeed = "LSL:streamfeed/";
constexpr std::string_view kTime = "LSL:timedata";
constexpr std::string_view kEndOfLine = "\r\n";
constexpr std::string_view kBlanks = " \t\r\n";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

/// Takes a line without its end, which is `\n` with or without `\r` before it. Returns none if
/// no line is complete.
std::optional<std::string_view> take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  if (end == std::string_view::npos) return std::nullopt;
  const std::string_view line = trimmed(text.substr(0, end));
  text.remove_prefix(end + 1);
  return line;
}

std::string_view take_token(std::string_view& text) {
  text = trimmed(text);
  const std::size_t end = std::min(text.find_first_of(kBlanks), text.size());
  const std::string_view token = text.substr(0, end);
  text.remove_prefix(end);
  return token;
}

template <typename Number>
std::optional<Number> number_in(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Takes a time. Returns none for what is no valid time.
std::optional<double> take_time(std::string_view& text) {
  const auto value = number_in<double>(take_token(text));
  constexpr double kLatest_s = 1e12;
  if (!value || !(std::abs(*value) < kLatest_s)) return std::nullopt;
  return value;
}

std::string time_text(double time_s) {
  std::array<char, 40> text;
  std::snprintf(text.data(), text.size(), "%.17g", time_s);
  return text.data();
}

/// A line "Key: value; remark". The part before the colon is in lower case.
struct HeaderLine {
  std::string key;
  std::string_view value;
};
std::optional<HeaderLine> header_line(std::string_view line) {
  line = line.substr(0, line.find(';'));
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  HeaderLine read{.value = trimmed(line.substr(colon + 1))};
  for (const char letter : trimmed(line.substr(0, colon))) {
    read.key += letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
  }
  return read;
}

StreamRequest feed_request_of(std::string_view first_line, std::string_view rest) {
  AsksFeed asks;
  first_line.remove_prefix(kFeed.size());
  const auto version = number_in<int>(take_token(first_line));
  if (!version || *version < kStreamProtocol || *version >= 200) return AsksNonsense{};
  asks.version = *version;
  asks.uid = take_token(first_line);
  while (true) {
    const auto line = take_line(rest);
    if (!line) return AsksForMore{};
    if (line->empty()) return asks;
    const auto header = header_line(*line);
    if (!header) continue;
    const auto number = number_in<int>(header->value);
    if (header->key == "has-ieee754-floats") asks.has_ieee_numbers = header->value != "0";
    if (header->key == "value-size" && number) asks.value_bytes = *number;
    if (header->key == "max-buffer-length" && number) asks.max_buffered = *number;
  }
}

}  // namespace

std::string search_message(const StreamSearch& search) {
  return std::string(kSearch) + "\r\n" + search.query + "\r\n" +
         std::to_string(search.return_port) + " " + search.id + "\r\n";
}

std::optional<StreamSearch> search_of(std::string_view datagram) {
  if (take_line(datagram) != kSearch) return std::nullopt;
  const auto query = take_line(datagram);
  if (!query) return std::nullopt;
  const auto port = number_in<std::uint16_t>(take_token(datagram));
  const std::string_view id = take_token(datagram);
  constexpr std::size_t kLongestId = 64;
  if (!port || *port == 0 || id.empty() || id.size() > kLongestId) return std::nullopt;
  return StreamSearch{
      .query = std::string(*query), .return_port = *port, .id = std::string(id)};
}

std::string found_message(const std::string& id, const std::string& short_xml) {
  return id + "\r\n" + short_xml;
}

std::optional<std::string> found_of(std::string_view datagram, const std::string& id) {
  if (take_line(datagram) != std::string_view(id)) return std::nullopt;
  return std::string(datagram);
}

std::string time_question_message(const TimeQuestion& question) {
  return std::string(kTime) + "\r\n" + std::to_string(question.wave) + " " +
         time_text(question.t0_s) + "\r\n";
}

std::optional<TimeQuestion> time_question_of(std::string_view datagram) {
  if (take_line(datagram) != kTime) return std::nullopt;
  const auto wave = number_in<int>(take_token(datagram));
  const auto t0_s = take_time(datagram);
  if (!wave || !t0_s) return std::nullopt;
  return TimeQuestion{.wave = *wave, .t0_s = *t0_s};
}

std::string time_answer_message(const TimeAnswer& answer) {
  return " " + std::to_string(answer.wave) + " " + time_text(answer.t0_s) + " " +
         time_text(answer.t1_s) + " " + time_text(answer.t2_s);
}

std::optional<TimeAnswer> time_answer_of(std::string_view datagram) {
  const auto wave = number_in<int>(take_token(datagram));
  const auto t0_s = take_time(datagram);
  const auto t1_s = take_time(datagram);
  const auto t2_s = take_time(datagram);
  if (!wave || !t0_s || !t1_s || !t2_s) return std::nullopt;
  return TimeAnswer{.wave = *wave, .t0_s = *t0_s, .t1_s = *t1_s, .t2_s = *t2_s};
}

StreamRequest request_of(std::string_view bytes) {
  if (bytes.size() > kMostRequestBytes) return AsksNonsense{};
  const auto first = take_line(bytes);
  if (!first) return AsksForMore{};
  if (*first == kFullInfo) return AsksFullInfo{};
  if (*first == kSearch) {
    const auto query = take_line(bytes);
    if (!query) return AsksForMore{};
    return AsksShortInfo{.query = std::string(*query)};
  }
  if (first->starts_with(kFeed)) return feed_request_of(*first, bytes);
  return AsksNonsense{};
}

/// Older outlets want to know how large texts are in memory.
std::string feed_request_message(const StreamInfo& info, int max_buffered) {
  const auto line = [](std::string_view key, const std::string& value) {
    return std::string(key) + ": " + value + std::string(kEndOfLine);
  };
  return std::string(kFeed) + std::to_string(kStreamProtocol) + " " + info.uid + "\r\n" +
         line("Native-Byte-Order", "1234") + line("Endian-Performance", "0") +
         line("Has-IEEE754-Floats", "1") + line("Supports-Subnormals", "1") +
         line("Value-Size", std::to_string(info.format == ChannelFormat::kString
                                               ? sizeof(std::string)
                                               : value_bytes(info.format))) +
         line("Data-Protocol-Version", std::to_string(kStreamProtocol)) +
         line("Max-Buffer-Length", std::to_string(max_buffered)) +
         line("Max-Chunk-Length", "0") + line("Hostname", info.hostname) +
         line("Source-Id", info.source_id) + line("Session-Id", info.session_id) + "\r\n";
}

std::string full_info_request_message() { return std::string(kFullInfo) + "\r\n"; }

std::string feed_answer_message(const std::string& uid) {
  return "LSL/" + std::to_string(kStreamProtocol) + " 200 OK\r\nUID: " + uid +
         "\r\nByte-Order: 1234\r\nSuppress-Subnormals: 0\r\nData-Protocol-Version: " +
         std::to_string(kStreamProtocol) + "\r\n\r\n";
}

std::string refusal_message(int code, std::string_view words) {
  return "LSL/" + std::to_string(kStreamProtocol) + " " + std::to_string(code) + " " +
         std::string(words) + "\r\n\r\n";
}

std::optional<FeedAnswer> feed_answer_of(std::string_view bytes) {
  const std::string_view whole = bytes;
  const auto too_long = [&whole] {
    if (whole.size() <= kMostRequestBytes) return;
    throw Error("stream: expected an answer of at most " + std::to_string(kMostRequestBytes) +
                " bytes, found a longer one");
  };
  auto line = take_line(bytes);
  if (!line) {
    too_long();
    return std::nullopt;
  }
  FeedAnswer answer;
  const std::string_view version = take_token(*line);
  const auto code = number_in<int>(take_token(*line));
  if (!version.starts_with("LSL/") || !code) {
    throw Error("stream: expected an answer that begins with LSL/ and a code, found another");
  }
  answer.code = *code;
  while (answer.code == 200) {
    line = take_line(bytes);
    if (!line) {
      too_long();
      return std::nullopt;
    }
    if (line->empty()) break;
    const auto header = header_line(*line);
    if (!header) continue;
    const auto number = number_in<int>(header->value);
    if (header->key == "uid") answer.uid = header->value;
    if (header->key == "byte-order") {
      // Some outlets send 0 if no byte order has to be changed.
      if (!number || (*number != 1234 && *number != 4321 && *number != 0)) {
        throw Error("stream: expected a byte order of 1234 or 4321, found another");
      }
      answer.big_endian = *number == 4321;
    }
    if (header->key == "data-protocol-version" && number) answer.data_version = *number;
  }
  answer.num_bytes = whole.size() - bytes.size();
  return answer;
}

}  // namespace jnd::core
