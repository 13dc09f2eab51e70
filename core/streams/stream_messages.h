#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "core/streams/stream_info.h"

namespace jnd::core {

/// What outlets and inlets write to each other besides samples, as text. What is no such
/// message comes back as nothing, and is left unanswered. Not real time.

// Datagrams.

/// Who sends a stream like this? The answer goes to a port of whoever asks.
struct StreamSearch {
  std::string query;
  std::uint16_t return_port = 0;
  std::string id;  ///< Of the question; the answer repeats it.
};
[[nodiscard]] std::string search_message(const StreamSearch& search);
[[nodiscard]] std::optional<StreamSearch> search_of(std::string_view datagram);

[[nodiscard]] std::string found_message(const std::string& id, const std::string& short_xml);
/// The description, where the datagram is an answer to this question.
[[nodiscard]] std::optional<std::string> found_of(std::string_view datagram,
                                                  const std::string& id);

/// What time is it there? `t0_s`: when it was sent, by the asker's clock.
struct TimeQuestion {
  int wave = 0;
  double t0_s = 0.0;
};
[[nodiscard]] std::string time_question_message(const TimeQuestion& question);
[[nodiscard]] std::optional<TimeQuestion> time_question_of(std::string_view datagram);

/// `t1_s` and `t2_s`: when the question came and when the answer went, by the other's clock.
struct TimeAnswer {
  int wave = 0;
  double t0_s = 0.0, t1_s = 0.0, t2_s = 0.0;
};
[[nodiscard]] std::string time_answer_message(const TimeAnswer& answer);
[[nodiscard]] std::optional<TimeAnswer> time_answer_of(std::string_view datagram);

// What an inlet asks for by a connection.

struct AsksForMore {};   ///< It has not asked to the end yet.
struct AsksNonsense {};  ///< Nothing that we answer; protocol 1.00 among it.
struct AsksFullInfo {};
struct AsksShortInfo {
  std::string query;
};
struct AsksFeed {
  int version = kStreamProtocol;
  std::string uid;  ///< "": whatever stream is here.
  bool has_ieee_numbers = true;
  int value_bytes = 0;
  int max_buffered = 0;  ///< In samples; 0: it only wants to see whether it could.
};
using StreamRequest =
    std::variant<AsksForMore, AsksNonsense, AsksFullInfo, AsksShortInfo, AsksFeed>;
/// A request that is longer is nonsense.
inline constexpr std::size_t kMostRequestBytes = 16384;
[[nodiscard]] StreamRequest request_of(std::string_view bytes);

/// `max_buffered`: how many samples are kept for us while we are slow.
[[nodiscard]] std::string feed_request_message(const StreamInfo& info, int max_buffered);
[[nodiscard]] std::string full_info_request_message();

/// What begins the feed: a line with a code, lines with parameters, an empty one.
struct FeedAnswer {
  int code = 200;  ///< 200: samples follow; 404: this stream is gone.
  std::string uid;
  bool big_endian = false;
  int data_version = kStreamProtocol;
  std::size_t num_bytes = 0;  ///< Of the text.
};
[[nodiscard]] std::string feed_answer_message(const std::string& uid);
[[nodiscard]] std::string refusal_message(int code, std::string_view words);
/// None where the rest is still to come. Throws `Error` for what is no such answer.
[[nodiscard]] std::optional<FeedAnswer> feed_answer_of(std::string_view bytes);

}  // namespace jnd::core
