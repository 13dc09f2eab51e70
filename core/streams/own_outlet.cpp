#include <poll.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <deque>
#include <list>
#include <mutex>
#include <string_view>
#include <thread>
#include <utility>

#include "core/error.h"
#include "core/streams/stream_messages.h"
#include "core/streams/stream_outlet.h"
#include "core/streams/stream_query.h"
#include "core/streams/stream_wire.h"

namespace jnd::core {
namespace {

constexpr std::size_t kMostConsumers = 64;
constexpr std::size_t kBytesAtOnce = 65536;
/// A consumer that connects and says nothing for this time is disconnected.
constexpr double kPatienceWithRequest_s = 10.0;
constexpr double kPatienceAtEnd_s = 1.0;
constexpr double kSamplesPerSecondOfEvents = 100.0;
/// The largest number of samples kept for one consumer, whatever it asks for.
constexpr std::size_t kMostKeptSamples = std::size_t{1} << 20;

using SharedBytes = std::shared_ptr<const std::string>;

/// A consumer that connected to us. Only the serving thread uses the members that are not
/// marked otherwise.
struct Consumer {
  StreamSocket socket;
  double since_s = 0.0;
  std::string request;
  std::string sending;  ///< Bytes after `num_sent` are those that the socket has not taken yet.
  std::size_t num_sent = 0;
  bool ends_when_sent = false;
  bool is_gone = false;
  // The outlet's mutex guards these.
  bool is_fed = false;
  std::size_t most_queued = 0;
  std::deque<SharedBytes> queue;

  [[nodiscard]] bool has_to_send() const noexcept { return num_sent < sending.size(); }
};

class OwnOutlet final : public StreamOutlet {
 public:
  OwnOutlet(StreamInfo info, const StreamNetwork& network, double seconds_kept)
      : info_(std::move(info)),
        network_(network),
        most_kept_(kept_samples(info_, seconds_kept)),
        service_(service_socket(network)),
        listener_(listening_socket(network)) {
    try {
      search_ = search_socket(network);
    } catch (const Error&) {
      // Programs that know this machine find the stream by its service port.
    }
    info_.uid = new_stream_uid();
    info_.created_at_s = network_.clock_s();
    info_.hostname = own_hostname();
    info_.session_id = network_.session_id;
    info_.v4_data_port = listener_.port();
    info_.v4_service_port = service_.port();
    short_info_ = stream_xml(info_, /*with_description=*/false);
    short_text_ = xml_text(short_info_);
    full_text_ = xml_text(stream_xml(info_, /*with_description=*/true));
    thread_ = std::thread([this] { serve(); });
  }

  ~OwnOutlet() override {
    is_ending_ = true;
    wake_.wake();
    thread_.join();
  }

  OwnOutlet(const OwnOutlet&) = delete;
  OwnOutlet& operator=(const OwnOutlet&) = delete;

  void push(const std::vector<StreamSample>& samples) override {
    std::vector<SharedBytes> encoded;
    encoded.reserve(samples.size());
    for (const StreamSample& sample : samples) {
      auto bytes = std::make_shared<std::string>();
      append_sample(*bytes, sample, info_.format);
      encoded.push_back(std::move(bytes));
    }
    bool any = false;
    {
      const std::lock_guard guard(mutex_);
      for (Consumer& consumer : consumers_) {
        if (!consumer.is_fed) continue;
        any = true;
        consumer.queue.insert(consumer.queue.end(), encoded.begin(), encoded.end());
        while (consumer.queue.size() > consumer.most_queued) {
          consumer.queue.pop_front();
          ++num_dropped_;
        }
      }
    }
    if (any) wake_.wake();
  }

  const StreamInfo& info() const noexcept override { return info_; }

  int num_consumers() const override {
    const std::lock_guard guard(mutex_);
    return static_cast<int>(std::ranges::count_if(consumers_, &Consumer::is_fed));
  }

  std::int64_t num_dropped() const override { return num_dropped_; }

 private:
  static std::size_t kept_samples(const StreamInfo& info, double seconds_kept) {
    const double rate =
        info.nominal_rate_hz > 0.0 ? info.nominal_rate_hz : kSamplesPerSecondOfEvents;
    const double most =
        std::clamp(std::ceil(rate * seconds_kept), 1.0, static_cast<double>(kMostKeptSamples));
    return static_cast<std::size_t>(most);
  }

  void serve() noexcept {
    try {
      double give_up_s = 0.0;
      while (true) {
        if (is_ending_) {
          if (give_up_s == 0.0) give_up_s = stream_clock_s() + kPatienceAtEnd_s;
          if (!fill_all() || stream_clock_s() > give_up_s) return;
        }
        serve_once();
      }
    } catch (const std::exception&) {
      // Without memory there is no stream, and the session continues without it.
    }
  }

  /// Returns whether anything is left to send.
  bool fill_all() {
    bool any = false;
    for (Consumer& consumer : consumers_) {
      fill(consumer);
      any = any || (!consumer.is_gone && consumer.has_to_send());
    }
    return any;
  }

  void serve_once() {
    std::vector<pollfd> waits = {{wake_.descriptor(), POLLIN, 0},
                                 {service_.descriptor(), POLLIN, 0},
                                 // `poll` ignores the descriptor -1.
                                 {search_.descriptor(), POLLIN, 0},
                                 {listener_.descriptor(), POLLIN, 0}};
    const std::size_t num_own = waits.size();
    for (Consumer& consumer : consumers_) {
      fill(consumer);
      const short events = consumer.has_to_send() ? POLLIN | POLLOUT : POLLIN;
      waits.push_back({consumer.socket.descriptor(), events, 0});
    }
    constexpr int kGlance_ms = 500;
    constexpr int kGlanceAtEnd_ms = 20;
    (void)::poll(waits.data(), waits.size(), is_ending_ ? kGlanceAtEnd_ms : kGlance_ms);
    if (waits[0].revents != 0) wake_.clear();
    if (waits[1].revents != 0) answer_datagrams(service_, /*tells_time=*/true);
    if (waits[2].revents != 0) answer_datagrams(search_, /*tells_time=*/false);
    std::size_t next = num_own;
    for (Consumer& consumer : consumers_) {
      const short came = waits[next++].revents;
      if ((came & (POLLERR | POLLNVAL)) != 0) consumer.is_gone = true;
      if ((came & (POLLIN | POLLHUP)) != 0) hear(consumer);
      if (consumer.has_to_send()) send(consumer);
      const bool is_mute = !consumer.is_fed && !consumer.ends_when_sent &&
                           stream_clock_s() > consumer.since_s + kPatienceWithRequest_s;
      if (is_mute) consumer.is_gone = true;
    }
    if (waits[3].revents != 0) accept();
    const std::lock_guard guard(mutex_);
    std::erase_if(consumers_, [](const Consumer& consumer) { return consumer.is_gone; });
  }

  void answer_datagrams(const StreamSocket& socket, bool tells_time) {
    // This limit keeps a flood of datagrams from delaying the others.
    constexpr int kMostAtOnce = 64;
    for (int i = 0; i < kMostAtOnce; ++i) {
      const auto came = receive_datagram(socket);
      if (!came) return;
      const double t1_s = network_.clock_s();
      if (const auto search = search_of(came->bytes)) {
        if (!matches_query(short_info_, search->query)) continue;
        (void)send_datagram(socket, found_message(search->id, short_text_),
                            {.host = came->from.host, .port = search->return_port});
      } else if (const auto question = time_question_of(came->bytes); question && tells_time) {
        (void)send_datagram(socket,
                            time_answer_message({.wave = question->wave,
                                                 .t0_s = question->t0_s,
                                                 .t1_s = t1_s,
                                                 .t2_s = network_.clock_s()}),
                            came->from);
      }
    }
  }

  void accept() {
    while (true) {
      StreamSocket socket = accepted_socket(listener_);
      if (!socket.is_open()) return;
      const std::lock_guard guard(mutex_);
      if (consumers_.size() >= kMostConsumers) continue;  // The socket is closed at once.
      Consumer& consumer = consumers_.emplace_back();
      consumer.socket = std::move(socket);
      consumer.since_s = stream_clock_s();
    }
  }

  /// Hears a request. After the request a consumer that gets the feed sends nothing more.
  void hear(Consumer& consumer) {
    const auto bytes = receive_bytes(consumer.socket);
    if (!bytes) {
      consumer.is_gone = true;
      return;
    }
    if (consumer.is_fed || consumer.ends_when_sent) return;
    consumer.request += *bytes;
    const StreamRequest request = request_of(consumer.request);
    if (std::holds_alternative<AsksForMore>(request)) return;
    consumer.request.clear();
    if (std::holds_alternative<AsksFullInfo>(request)) {
      tell_and_end(consumer, full_text_);
    } else if (const auto* asks = std::get_if<AsksShortInfo>(&request)) {
      tell_and_end(consumer, matches_query(short_info_, asks->query) ? short_text_ : "");
    } else if (const auto* feed = std::get_if<AsksFeed>(&request)) {
      feed_to(consumer, *feed);
    } else {
      consumer.is_gone = true;
    }
  }

  static void tell_and_end(Consumer& consumer, std::string text) {
    consumer.sending = std::move(text);
    consumer.num_sent = 0;
    consumer.ends_when_sent = true;
    if (consumer.sending.empty()) consumer.is_gone = true;
  }

  void feed_to(Consumer& consumer, const AsksFeed& asks) {
    if (!asks.uid.empty() && asks.uid != info_.uid) {
      return tell_and_end(consumer, refusal_message(404, "Not found"));
    }
    const auto width = static_cast<int>(value_bytes(info_.format));
    if (!asks.has_ieee_numbers || (width > 0 && asks.value_bytes != width)) {
      return tell_and_end(consumer, refusal_message(505, "Version not supported"));
    }
    std::string begin = feed_answer_message(info_.uid);
    append_sample(begin, test_sample(info_.format, info_.channel_count, 4), info_.format);
    append_sample(begin, test_sample(info_.format, info_.channel_count, 2), info_.format);
    if (asks.max_buffered <= 0) return tell_and_end(consumer, std::move(begin));
    consumer.sending = std::move(begin);
    consumer.num_sent = 0;
    const std::lock_guard guard(mutex_);
    consumer.most_queued = std::min(most_kept_, static_cast<std::size_t>(asks.max_buffered));
    consumer.is_fed = true;
  }

  /// Takes the bytes that are sent next from the queue.
  void fill(Consumer& consumer) {
    if (consumer.has_to_send() || !consumer.is_fed) return;
    consumer.sending.clear();
    consumer.num_sent = 0;
    const std::lock_guard guard(mutex_);
    while (!consumer.queue.empty() && consumer.sending.size() < kBytesAtOnce) {
      consumer.sending += *consumer.queue.front();
      consumer.queue.pop_front();
    }
  }

  static void send(Consumer& consumer) {
    const auto count = send_bytes(consumer.socket,
                                  std::string_view(consumer.sending).substr(consumer.num_sent));
    if (!count) {
      consumer.is_gone = true;
      return;
    }
    consumer.num_sent += *count;
    if (!consumer.has_to_send() && consumer.ends_when_sent) consumer.is_gone = true;
  }

  StreamInfo info_;
  StreamNetwork network_;
  std::size_t most_kept_;
  StreamSocket service_, listener_, search_;
  StreamWake wake_;
  XmlElement short_info_;
  std::string short_text_, full_text_;
  /// Guards the list, and the members of its consumers that are marked so.
  mutable std::mutex mutex_;
  std::list<Consumer> consumers_;
  std::atomic<std::int64_t> num_dropped_{0};
  std::atomic<bool> is_ending_{false};
  std::thread thread_;
};

}  // namespace

std::unique_ptr<StreamOutlet> open_own_outlet(StreamInfo info, const StreamNetwork& network,
                                              double seconds_kept) {
  return std::make_unique<OwnOutlet>(std::move(info), network, seconds_kept);
}

}  // namespace jnd::core
