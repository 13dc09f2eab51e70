#include "app/session/session_streams.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>
#include <variant>

#include "core/clock.h"
#include "core/error.h"
#include "core/exchange/spsc_queue.h"
#include "core/storage/stream_file.h"
#include "core/streams/lsl_library.h"
#include "core/streams/sample_stream.h"
#include "core/streams/stream_inlet.h"
#include "core/streams/stream_outlet.h"
#include "core/streams/stream_search.h"

namespace jnd::app {
namespace {

using namespace std::chrono_literals;
using experiments::StreamClosed;
using experiments::StreamFailed;
using experiments::StreamOpened;

/// Eight seconds at 1 kHz.
constexpr std::size_t kStreamQueueCapacity = 8192;
constexpr auto kBetweenSendings = 10ms;
constexpr auto kBetweenTakings = 100ms;
constexpr double kSearchOnce_s = 1.0;
constexpr double kBetweenFlushes_s = 1.0;
/// The end of a session may have to wait so long for it.
constexpr double kPatienceToOpen_s = 2.0;
/// After this time, a missing stream is reported; the search goes on.
constexpr double kPatienceWithStream_s = 10.0;
constexpr std::array<std::string_view, 4> kSearchKeys = {"name", "type", "source_id",
                                                         "hostname"};

constexpr char kOut[] = "out", kIn[] = "in";

}  // namespace

/// Something that the session's thread has yet to commit.
using StreamNotice = std::variant<StreamOpened, StreamClosed, StreamFailed>;

/// Somebody else's stream, and the file to which it is recorded.
struct RecordedStream {
  std::unique_ptr<core::StreamInlet> inlet;
  /// nullptr if the stream is no longer recorded.
  std::unique_ptr<core::StreamFileWriter> file;
  StreamClosed closed{.direction = kIn};
  bool was_lost = false;
};

/// A stream that is searched for, and whether it was found.
struct StreamHunt {
  std::string asked, query;
  bool is_over = false, is_told = false;
};

namespace {

StreamOpened opened(const char* direction, const core::StreamInfo& info,
                    const std::string& by) {
  return {.direction = direction,
          .name = info.name,
          .type = info.type,
          .channel_format = std::string(core::name(info.format)),
          .source_id = info.source_id,
          .hostname = direction == std::string_view(kIn) ? info.hostname : "",
          .channel_count = info.channel_count,
          .nominal_rate_hz = info.nominal_rate_hz,
          .by = by};
}

}  // namespace

std::pair<std::string, std::string> searched_for(const std::string& inlet) {
  const std::size_t equals = inlet.find('=');
  const std::string key = inlet.substr(0, equals);
  const bool is_known = std::ranges::find(kSearchKeys, key) != kSearchKeys.end();
  if (is_known && equals != std::string::npos && equals + 1 < inlet.size()) {
    return {key, inlet.substr(equals + 1)};
  }
  throw core::Error(
      "streams: expected what to record as type=EEG, or by name, source_id or "
      "hostname, found `" +
      inlet.substr(0, 60) + "`");
}

void require_possible(const WantedStreams& wanted, bool hides_levels) {
  for (const std::string& inlet : wanted.inlets) (void)searched_for(inlet);
  if (wanted.samples) (void)core::SampleStream(wanted.channels);
  if (!wanted.library.empty()) (void)core::LslLibrary(wanted.library);
  if (wanted.samples && hides_levels) {
    throw core::Error(
        "streams: expected no samples of a double-blind study, for a force tells "
        "the level, found that they are asked for; send markers, and export the "
        "samples once the study is unblinded");
  }
}

struct SessionStreams::Implementation {
  explicit Implementation(Parameters the_parameters)
      : parameters(std::move(the_parameters)), sample_stream(std::vector<std::string>{}) {
    parameters.network.peers = parameters.wanted.peers;
    attempt(kOut, "liblsl", [this] {
      if (parameters.wanted.library.empty()) return;
      library = std::make_shared<const core::LslLibrary>(parameters.wanted.library);
      by = library->words();
    });
    if (parameters.wanted.markers) {
      attempt(kOut, "markers",
              [this] { markers = outlet(core::marker_stream_info(parameters.facts)); });
    }
    if (parameters.wanted.samples) {
      attempt(kOut, "samples", [this] {
        require_possible({.samples = true, .channels = parameters.wanted.channels},
                         parameters.hides_levels);
        sample_stream = core::SampleStream(parameters.wanted.channels);
        samples = outlet(sample_stream.info(parameters.facts, parameters.rate_hz));
      });
    }
    for (const std::string& inlet : parameters.wanted.inlets) {
      attempt(kIn, inlet, [&] {
        const auto [key, value] = searched_for(inlet);
        hunts.push_back(
            {.asked = inlet, .query = core::query_for(parameters.network, key, value)});
      });
    }
    if (samples) sending = std::thread([this] { send_until_the_end(); });
    if (!hunts.empty()) recording = std::thread([this] { record_until_the_end(); });
  }

  ~Implementation() {
    end_recording();
    is_ending = true;
    if (sending.joinable()) sending.join();
  }

  template <typename Act>
  void attempt(const char* direction, const std::string& name, const Act& act) {
    try {
      act();
    } catch (const std::exception& error) {
      notice(StreamFailed{.direction = direction, .name = name, .problem = error.what()});
    }
  }

  void notice(StreamNotice one) {
    const std::lock_guard guard(mutex);
    notices.push_back(std::move(one));
  }

  std::unique_ptr<core::StreamOutlet> outlet(const core::StreamInfo& info) {
    auto made = library ? core::open_library_outlet(library, info)
                        : core::open_own_outlet(info, parameters.network);
    notice(opened(kOut, made->info(), by));
    return made;
  }

  void send_until_the_end() noexcept {
    try {
      for (bool is_last = false; !is_last;) {
        is_last = is_ending;
        send();
        if (!is_last) std::this_thread::sleep_for(kBetweenSendings);
      }
    } catch (const std::exception& error) {
      notice(StreamFailed{.direction = kOut, .name = "samples", .problem = error.what()});
    }
  }

  void send() {
    constexpr double kSPerNs = 1e-9;
    std::vector<core::StreamSample> batch;
    queue.drain([&](const core::Sample& sample) {
      batch.push_back(
          sample_stream.sample(sample, kSPerNs * static_cast<double>(sample.monotonic_ns)));
    });
    if (batch.empty()) return;
    samples->push(batch);
    num_samples_sent += static_cast<std::int64_t>(batch.size());
  }

  void record_until_the_end() noexcept {
    try {
      const double begun_s = core::stream_clock_s();
      double next_flush_s = 0.0;
      while (!is_recording_over) {
        if (!search(begun_s)) std::this_thread::sleep_for(kBetweenTakings);
        const bool flushes = core::stream_clock_s() >= next_flush_s;
        for (RecordedStream& stream : streams) take(stream, flushes);
        if (flushes) next_flush_s = core::stream_clock_s() + kBetweenFlushes_s;
      }
      for (RecordedStream& stream : streams) seal(stream);
    } catch (const std::exception& error) {
      notice(StreamFailed{.direction = kIn, .name = "inlets", .problem = error.what()});
    }
  }

  /// Searches once for what is missing. Returns false if there is nothing to search for.
  bool search(double begun_s) {
    bool any = false;
    for (StreamHunt& hunt : hunts) {
      if (hunt.is_over || is_recording_over) continue;
      any = true;
      attempt(kIn, hunt.asked, [&] { search_for(hunt); });
      const bool is_late = core::stream_clock_s() > begun_s + kPatienceWithStream_s;
      if (hunt.is_over || hunt.is_told || !is_late) continue;
      hunt.is_told = true;
      notice(StreamFailed{.direction = kIn,
                          .name = hunt.asked,
                          .problem = "streams: expected one of " + hunt.asked +
                                     ", found none; it is looked for further on"});
    }
    return any;
  }

  void search_for(StreamHunt& hunt) {
    const auto found = library
                           ? core::find_library_streams(*library, hunt.query, kSearchOnce_s)
                           : core::find_streams(parameters.network, hunt.query, kSearchOnce_s,
                                                0, [this] { return is_recording_over.load(); });
    for (const core::StreamInfo& info : found) {
      const auto is_this = [&info](const std::unique_ptr<core::StreamOutlet>& own) {
        return own != nullptr && own->info().uid == info.uid;
      };
      const bool is_recorded = std::ranges::any_of(streams, [&info](const RecordedStream& one) {
        return one.inlet->info().uid == info.uid;
      });
      if (is_this(markers) || is_this(samples) || is_recorded) continue;
      // A stream that cannot be opened is reported once and not tried again.
      hunt.is_over = true;
      attempt(kIn, info.name, [&] { open(info); });
    }
  }

  void open(const core::StreamInfo& info) {
    RecordedStream stream;
    stream.inlet = library ? core::open_library_inlet(library, info, kPatienceToOpen_s)
                           : core::open_own_inlet(info, parameters.network, kPatienceToOpen_s);
    const std::filesystem::path file = core::next_stream_file(parameters.recording);
    stream.file = std::make_unique<core::StreamFileWriter>(
        file, core::StreamFileInfo{.name = info.name,
                                   .type = info.type,
                                   .format = info.format,
                                   .channel_count = info.channel_count,
                                   .nominal_rate_hz = info.nominal_rate_hz,
                                   .xml = stream.inlet->full_xml()});
    stream.closed.name = info.name;
    stream.closed.file = file.filename().string();
    StreamOpened told = opened(kIn, info, by);
    told.file = stream.closed.file;
    streams.push_back(std::move(stream));
    notice(told);
  }

  /// Records what has come in. If it cannot be stored, an event tells so, and the stream is not
  /// recorded any further.
  void take(RecordedStream& stream, bool flushes) {
    if (!stream.file) return;
    attempt(kIn, stream.closed.name, [&] {
      try {
        for (const core::StreamSample& sample : stream.inlet->take_samples()) {
          stream.file->append(sample);
        }
        for (const core::ClockOffset& offset : stream.inlet->take_offsets()) {
          stream.file->append(offset);
        }
        if (flushes) stream.file->flush();
      } catch (const std::exception&) {
        stream.file.reset();
        throw;
      }
    });
    const bool is_lost = stream.inlet->state() == core::StreamInlet::State::kLost;
    if (is_lost && !stream.was_lost) {
      notice(StreamFailed{
          .direction = kIn, .name = stream.closed.name, .problem = stream.inlet->problem()});
    }
    stream.was_lost = is_lost;
  }

  void seal(RecordedStream& stream) {
    take(stream, /*flushes=*/false);
    stream.closed.num_dropped = stream.inlet->num_dropped();
    stream.inlet.reset();
    if (!stream.file) return;
    attempt(kIn, stream.closed.name, [&] {
      const core::StreamFileSeal seal = stream.file->seal();
      stream.closed.num_samples = seal.num_samples;
      stream.closed.num_offsets = seal.num_offsets;
      stream.closed.sha256 = seal.sha256;
      notice(stream.closed);
    });
  }

  void end_recording() {
    is_recording_over = true;
    if (recording.joinable()) recording.join();
  }

  void tell_outlets() {
    const auto told = [this](const core::StreamOutlet* one, std::int64_t num_samples,
                             std::int64_t num_dropped) {
      if (one == nullptr) return;
      notice(StreamClosed{.direction = kOut,
                          .name = one->info().name,
                          .num_samples = num_samples,
                          .num_dropped = one->num_dropped() + num_dropped});
    };
    told(markers.get(), num_markers_sent, 0);
    told(samples.get(), num_samples_sent, static_cast<std::int64_t>(queue.num_dropped()));
  }

  Parameters parameters;
  std::shared_ptr<const core::LslLibrary> library;
  std::string by = "jnd";
  core::SampleStream sample_stream;
  core::SessionMarkers marker_maker;
  std::unique_ptr<core::StreamOutlet> markers, samples;
  core::SpscQueue<core::Sample> queue{kStreamQueueCapacity};
  std::int64_t num_markers_sent = 0;
  std::atomic<std::int64_t> num_samples_sent{0};
  std::vector<StreamHunt> hunts;        ///< Used by the recording thread alone, once it runs.
  std::vector<RecordedStream> streams;  ///< Used by the recording thread alone, once it runs.
  std::mutex mutex;                     ///< Protects the notices.
  std::vector<StreamNotice> notices;
  bool is_closed = false;
  std::atomic<bool> is_ending{false}, is_recording_over{false};
  std::thread sending, recording;
};

SessionStreams::SessionStreams(const Parameters& parameters)
    : implementation_(std::make_unique<Implementation>(parameters)) {}

SessionStreams::~SessionStreams() = default;

void SessionStreams::take(const core::Sample& sample) noexcept {
  if (implementation_->samples) (void)implementation_->queue.try_push(sample);
}

void SessionStreams::tell(const core::EventRow& event) {
  Implementation& my = *implementation_;
  if (!my.markers) return;
  std::optional<std::string> marker = my.marker_maker.marker_of(event);
  if (!marker) return;
  // The event's time comes from the clock of the day, and streams have another clock. So the
  // event's age is used.
  const double ago_s = 1e-9 * static_cast<double>(core::SystemClock().now_ns() - event.time_ns);
  my.markers->push({{.time_s = core::stream_clock_s() - ago_s,
                     .values = {},
                     .texts = {std::move(*marker)}}});
  ++my.num_markers_sent;
}

void SessionStreams::follow(experiments::Session& session) {
  std::vector<StreamNotice> told;
  {
    const std::lock_guard guard(implementation_->mutex);
    told.swap(implementation_->notices);
  }
  for (StreamNotice& one : told) {
    if (auto* is_opened = std::get_if<StreamOpened>(&one)) {
      is_opened->monotonic_s = core::stream_clock_s();
      session.stream_opened(*is_opened);
    } else if (const auto* is_closed = std::get_if<StreamClosed>(&one)) {
      session.stream_closed(*is_closed);
    } else {
      session.stream_failed(std::get<StreamFailed>(one));
    }
  }
}

void SessionStreams::close(experiments::Session& session) {
  if (std::exchange(implementation_->is_closed, true)) return;
  implementation_->end_recording();
  implementation_->tell_outlets();
  follow(session);
}

}  // namespace jnd::app
