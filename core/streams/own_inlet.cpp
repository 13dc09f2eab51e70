#include <poll.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <random>
#include <thread>
#include <utility>

#include "core/error.h"
#include "core/streams/clock_probe.h"
#include "core/streams/feed_reader.h"
#include "core/streams/stream_inlet.h"
#include "core/streams/stream_messages.h"
#include "core/streams/stream_query.h"
#include "core/streams/stream_search.h"

namespace jnd::core {
namespace {

constexpr double kPatienceToConnect_s = 3.0;
constexpr double kBetweenAttempts_s = 0.5;
constexpr double kSearchAgain_s = 1.0;
constexpr double kLongestGlance_s = 0.1;
/// The largest number of samples that are kept until somebody takes them.
constexpr std::size_t kMostTaken = std::size_t{1} << 20;
constexpr std::size_t kMostTakenBytes = std::size_t{1} << 27;
/// The buffer that is requested from the outlet, which keeps as much as it can.
constexpr int kMaxBuffered = 1 << 20;

StreamAddress data_address(const StreamInfo& info) {
  const auto address = numeric_address(info.v4_address, info.v4_data_port);
  if (!address) {
    throw Error(
        "stream: expected an address of version 4, found none; streams of version 6 "
        "alone are not read");
  }
  return *address;
}

int milliseconds(double duration_s) {
  return static_cast<int>(std::ceil(1000.0 * std::clamp(duration_s, 0.0, kLongestGlance_s)));
}

/// Waits for the connection, or throws `Error`.
StreamSocket connected(const StreamInfo& info, double timeout_s,
                       const std::atomic<bool>& is_ending) {
  StreamSocket socket = connecting_socket(data_address(info));
  const double give_up_s = stream_clock_s() + timeout_s;
  pollfd waits{.fd = socket.descriptor(), .events = POLLOUT, .revents = 0};
  while (!is_ending && stream_clock_s() < give_up_s) {
    if (::poll(&waits, 1, milliseconds(kLongestGlance_s)) <= 0) continue;
    if (is_connected(socket)) return socket;
    break;
  }
  throw Error("stream: expected a connection to " + info.v4_address + ":" +
              std::to_string(info.v4_data_port) + ", found none");
}

void send_whole(const StreamSocket& socket, const std::string& request) {
  // The request fits into the buffer of any socket.
  if (send_bytes(socket, request) == request.size()) return;
  throw Error("stream: expected to ask for the stream, found the connection gone");
}

/// Returns everything that the other side sends before it ends the connection.
std::string full_xml_of(const StreamInfo& info, double timeout_s) {
  const std::atomic<bool> is_ending{false};
  const double give_up_s = stream_clock_s() + timeout_s;
  const StreamSocket socket = connected(info, timeout_s, is_ending);
  send_whole(socket, full_info_request_message());
  std::string text;
  pollfd waits{.fd = socket.descriptor(), .events = POLLIN, .revents = 0};
  while (stream_clock_s() < give_up_s && text.size() <= kMostXmlBytes) {
    if (::poll(&waits, 1, milliseconds(kLongestGlance_s)) <= 0) continue;
    const auto bytes = receive_bytes(socket);
    if (!bytes) break;
    text += *bytes;
  }
  const StreamInfo told = stream_info_from(text, "stream");
  const bool is_same = told.uid == info.uid && told.format == info.format &&
                       told.channel_count == info.channel_count;
  if (!is_same) throw Error("stream: expected the stream that was found, found another one");
  return text;
}

std::size_t bytes_of(const StreamSample& sample) {
  std::size_t bytes = sizeof sample + sample.values.size();
  for (const std::string& text : sample.texts) bytes += sizeof(std::string) + text.size();
  return bytes;
}

class OwnInlet final : public StreamInlet {
 public:
  OwnInlet(StreamInfo info, StreamNetwork network, double timeout_s)
      : info_(std::move(info)),
        place_(info_),
        network_(std::move(network)),
        full_xml_(full_xml_of(info_, timeout_s)),
        time_socket_(datagram_socket()),
        probe_(static_cast<int>(std::random_device{}() >> 2)) {
    thread_ = std::thread([this] { listen(); });
  }

  ~OwnInlet() override {
    is_ending_ = true;
    wake_.wake();
    thread_.join();
  }

  OwnInlet(const OwnInlet&) = delete;
  OwnInlet& operator=(const OwnInlet&) = delete;

  std::vector<StreamSample> take_samples() override {
    const std::lock_guard guard(mutex_);
    num_bytes_ = 0;
    return std::exchange(samples_, {});
  }

  std::vector<ClockOffset> take_offsets() override {
    const std::lock_guard guard(mutex_);
    return std::exchange(offsets_, {});
  }

  const StreamInfo& info() const noexcept override { return info_; }
  const std::string& full_xml() const noexcept override { return full_xml_; }

  State state() const override {
    const std::lock_guard guard(mutex_);
    return state_;
  }
  std::string problem() const override {
    const std::lock_guard guard(mutex_);
    return problem_;
  }
  std::int64_t num_dropped() const override { return num_dropped_; }

 private:
  void become(State state, const std::string& problem = "") {
    const std::lock_guard guard(mutex_);
    state_ = state;
    problem_ = problem;
  }

  void listen() noexcept {
    while (!is_ending_) {
      try {
        receive();
        become(State::kLost, "stream: expected more samples, found the connection ended");
      } catch (const StreamGone&) {
        become(State::kLost, "stream: expected it where it was, found another one there");
      } catch (const std::exception& error) {
        become(State::kLost, error.what());
      }
      if (!is_ending_) recover();
    }
  }

  /// Receives until the connection ends.
  void receive() {
    const StreamSocket socket = connected(place_, kPatienceToConnect_s, is_ending_);
    send_whole(socket, feed_request_message(place_, kMaxBuffered));
    FeedReader reader(place_);
    bool was_open = false;
    while (!is_ending_) {
      pollfd waits[] = {{socket.descriptor(), POLLIN, 0},
                        {time_socket_.descriptor(), POLLIN, 0},
                        {wake_.descriptor(), POLLIN, 0}};
      (void)::poll(waits, std::size(waits),
                   milliseconds(probe_.next_due_s() - network_.clock_s()));
      compare_clocks();
      if (waits[0].revents == 0) continue;
      const auto bytes = receive_bytes(socket);
      if (!bytes) return;
      reader.take(*bytes);
      std::vector<StreamSample> came;
      while (auto sample = reader.next()) came.push_back(std::move(*sample));
      if (reader.is_open() && !std::exchange(was_open, true)) become(State::kReceiving);
      keep(std::move(came));
    }
  }

  void keep(std::vector<StreamSample> came) {
    const std::lock_guard guard(mutex_);
    for (StreamSample& sample : came) {
      num_bytes_ += bytes_of(sample);
      samples_.push_back(std::move(sample));
    }
    std::size_t num_over = samples_.size() > kMostTaken ? samples_.size() - kMostTaken : 0;
    std::size_t num_gone = 0;
    while (num_gone < samples_.size() &&
           (num_gone < num_over || num_bytes_ > kMostTakenBytes)) {
      num_bytes_ -= bytes_of(samples_[num_gone++]);
    }
    if (num_gone == 0) return;
    samples_.erase(samples_.begin(), samples_.begin() + static_cast<std::ptrdiff_t>(num_gone));
    num_dropped_ += static_cast<std::int64_t>(num_gone);
  }

  void compare_clocks() {
    const auto to = numeric_address(place_.v4_address, place_.v4_service_port);
    if (!to) return;
    while (const auto came = receive_datagram(time_socket_)) {
      if (came->from == *to) probe_.take_answer(came->bytes, network_.clock_s());
    }
    if (const auto offset = probe_.finished(network_.clock_s())) {
      const std::lock_guard guard(mutex_);
      offsets_.push_back(*offset);
    }
    const std::string question = probe_.due_question(network_.clock_s());
    if (!question.empty()) (void)send_datagram(time_socket_, question, *to);
  }

  /// Looks for a stream that went away. It may be elsewhere, under another identity.
  void recover() {
    wait(kBetweenAttempts_s);
    if (is_ending_ || info_.source_id.empty()) return;
    const std::string query = query_for(network_, "source_id", info_.source_id) +
                              " and name=" + quoted_for_query(info_.name) +
                              " and type=" + quoted_for_query(info_.type);
    try {
      for (StreamInfo& found : find_streams(network_, query, kSearchAgain_s, 1,
                                            [this] { return is_ending_.load(); })) {
        if (found.format != info_.format || found.channel_count != info_.channel_count)
          continue;
        place_ = std::move(found);
        return;
      }
    } catch (const Error& error) {
      become(State::kLost, error.what());
    }
  }

  void wait(double duration_s) {
    const double end_s = stream_clock_s() + duration_s;
    pollfd waits{.fd = wake_.descriptor(), .events = POLLIN, .revents = 0};
    while (!is_ending_ && stream_clock_s() < end_s) {
      (void)::poll(&waits, 1, milliseconds(end_s - stream_clock_s()));
    }
  }

  const StreamInfo info_;
  StreamInfo place_;  ///< Where the stream is now. Only the thread uses it.
  StreamNetwork network_;
  std::string full_xml_;
  StreamSocket time_socket_;
  StreamWake wake_;
  ClockProbe probe_;
  mutable std::mutex mutex_;
  std::vector<StreamSample> samples_;
  std::size_t num_bytes_ = 0;
  std::vector<ClockOffset> offsets_;
  State state_ = State::kConnecting;
  std::string problem_;
  std::atomic<std::int64_t> num_dropped_{0};
  std::atomic<bool> is_ending_{false};
  std::thread thread_;
};

}  // namespace

std::unique_ptr<StreamInlet> open_own_inlet(const StreamInfo& info,
                                            const StreamNetwork& network, double timeout_s) {
  return std::make_unique<OwnInlet>(info, network, timeout_s);
}

}  // namespace jnd::core
