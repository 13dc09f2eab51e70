#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "core/streams/stream_info.h"

namespace jnd::core {

/// The text messages of outlets and inlets, apart from samples. The functions that read a
/// message return nothing for what is no such message; it is left unanswered. Not real time.

// The following messages are datagrams.

/// Asks who sends such a stream. The answer goes to a port of the asker.
struct StreamSearch {
  std::string query;
  std::uint16_t return_port = 0;
  std::string id;  ///< Id of the question, which the answer repeats.
};
[[nodiscard]] std::string search_message(const StreamSearch& search);
[[nodiscard]] std::optional<StreamSearch> search_of(std::string_view datagram);

[[nodiscard]] std::string found_message(const std::string& id, const std::string& short_xml);
/// Returns the description if the datagram is an answer to this question.
[[nodiscard]] std::optional<std::string> found_of(std::string_view datagram,
                                                  const std::string& id);

/// Asks for the time there. `t0_s` is when the question was sent, by the asker's clock.
struct TimeQuestion {
  int wave = 0;
  double t0_s = 0.0;
};
[[nodiscard]] std::string time_question_message(const TimeQuestion& question);
[[nodiscard]] std::optional<TimeQuestion> time_question_of(std::string_view datagram);

/// `t1_s` and `t2_s` are when the question arrived and when the answer was sent, by the other
/// clock.
struct TimeAnswer {
  int wave = 0;
  double t0_s = 0.0, t1_s = 0.0, t2_s = 0.0;
};
[[nodiscard]] std::string time_answer_message(const TimeAnswer& answer);
[[nodiscard]] std::optional<TimeAnswer> time_answer_of(std::string_view datagram);

// The requests that an inlet makes over a connection.

struct AsksForMore {};   ///< The request is not complete yet.
struct AsksNonsense {};  ///< A request that we do not answer, such as one of protocol 1.00.
struct AsksFullInfo {};
struct AsksShortInfo {
  std::string query;
};
struct AsksFeed {
  int version = kStreamProtocol;
  std::string uid;  ///< "" asks for whatever stream is here.
  bool has_ieee_numbers = true;
  int value_bytes = 0;
  int max_buffered = 0;  ///< In samples; 0 only tests whether a feed is possible.
};
using StreamRequest =
    std::variant<AsksForMore, AsksNonsense, AsksFullInfo, AsksShortInfo, AsksFeed>;
/// Longer requests are refused.
inline constexpr std::size_t kMostRequestBytes = 16384;
[[nodiscard]] StreamRequest request_of(std::string_view bytes);

/// `max_buffered` is the number of samples that the outlet keeps while we are slow.
[[nodiscard]] std::string feed_request_message(const StreamInfo& info, int max_buffered);
[[nodiscard]] std::string full_info_request_message();

/// The beginning of the feed: a line with a code, lines with parameters, and an empty line.
struct FeedAnswer {
  int code = 200;  ///< 200: samples follow; 404: this stream is gone.
  std::string uid;
  bool big_endian = false;
  int data_version = kStreamProtocol;
  std::size_t num_bytes = 0;  ///< Size of the text.
};
[[nodiscard]] std::string feed_answer_message(const std::string& uid);
[[nodiscard]] std::string refusal_message(int code, std::string_view words);
/// Returns none if more bytes have to come. Throws `Error` for what is no such answer.
[[nodiscard]] std::optional<FeedAnswer> feed_answer_of(std::string_view bytes);

}  // namespace jnd::core
