#include "core/streams/stream_search.h"

#include <poll.h>

#include <algorithm>
#include <random>

#include "core/error.h"
#include "core/streams/stream_messages.h"
#include "core/streams/stream_query.h"

namespace jnd::core {
namespace {

constexpr double kBetweenQuestions_s = 0.5;
constexpr double kGlance_s = 0.1;
/// No laboratory has more streams.
constexpr std::size_t kMostStreams = 256;

/// Returns the description with the address from which it came, or none if it is no stream.
std::optional<StreamInfo> stream_in(const ReceivedDatagram& came, const std::string& id) {
  const auto xml = found_of(came.bytes, id);
  if (!xml) return std::nullopt;
  try {
    StreamInfo info = stream_info_from(*xml, "stream");
    info.v4_address = host_text(came.from);
    if (info.v4_data_port == 0 || info.v4_service_port == 0) return std::nullopt;
    return info;
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace

std::vector<StreamInfo> find_streams(const StreamNetwork& network, const std::string& query,
                                     double timeout_s, int enough,
                                     const std::function<bool()>& is_cancelled) {
  const StreamSocket socket = datagram_socket();
  const std::string id = std::to_string(std::random_device{}());
  const std::string question =
      search_message({.query = query, .return_port = socket.port(), .id = id});
  std::vector<StreamInfo> found;
  const double begun_s = stream_clock_s();
  double next_question_s = begun_s;
  while (true) {
    const double now_s = stream_clock_s();
    if (now_s - begun_s >= timeout_s || (is_cancelled && is_cancelled())) return found;
    if (now_s >= next_question_s) {
      send_search(socket, question, network);
      next_question_s = now_s + kBetweenQuestions_s;
    }
    const double wait_s =
        std::min({next_question_s - now_s, begun_s + timeout_s - now_s, kGlance_s});
    pollfd waits{.fd = socket.descriptor(), .events = POLLIN, .revents = 0};
    (void)::poll(&waits, 1, static_cast<int>(1000.0 * std::max(wait_s, 0.0)) + 1);
    while (const auto came = receive_datagram(socket)) {
      auto info = stream_in(*came, id);
      if (!info || found.size() >= kMostStreams) continue;
      const bool is_known =
          std::ranges::find(found, info->uid, &StreamInfo::uid) != found.end();
      if (!is_known) found.push_back(std::move(*info));
    }
    if (enough > 0 && std::ssize(found) >= enough) return found;
  }
}

std::string query_for(const StreamNetwork& network, const std::string& key,
                      const std::string& value) {
  return "session_id=" + quoted_for_query(network.session_id) + " and " + key + "=" +
         quoted_for_query(value);
}

}  // namespace jnd::core
