#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/clock_offsets.h"
#include "core/stream_sample.h"
#include "core/streams/stream_info.h"
#include "core/streams/stream_network.h"

namespace jnd::core {

/// A stream of somebody else that we listen to. Safe to call from several threads. Not real
/// time.
class StreamInlet {
 public:
  enum class State {
    kConnecting,  ///< Nothing has come yet.
    kReceiving,
    kLost,  ///< The stream went away, and may come back.
  };

  virtual ~StreamInlet() = default;

  /// What has come since the last call, in order, with the times of the sender's clock.
  [[nodiscard]] virtual std::vector<StreamSample> take_samples() = 0;
  /// How the sender's clock compared with ours, since the last call.
  [[nodiscard]] virtual std::vector<ClockOffset> take_offsets() = 0;
  [[nodiscard]] virtual const StreamInfo& info() const noexcept = 0;
  /// All that the stream says of itself, as XML.
  [[nodiscard]] virtual const std::string& full_xml() const noexcept = 0;
  [[nodiscard]] virtual State state() const = 0;
  /// Why it is lost, a sentence; "" while it is not.
  [[nodiscard]] virtual std::string problem() const = 0;
  /// Samples that came and were not taken in time.
  [[nodiscard]] virtual std::int64_t num_dropped() const = 0;
};

/// One of our own, of a stream that was found: by protocol 1.10, on a thread of its own. A
/// connection that breaks is made anew; a stream with a `source_id` is looked for again where
/// it went, for it may come back elsewhere. Asks for the description first and throws `Error`
/// where that does not come in `timeout_s`.
[[nodiscard]] std::unique_ptr<StreamInlet> open_own_inlet(const StreamInfo& info,
                                                          const StreamNetwork& network,
                                                          double timeout_s = 5.0);

}  // namespace jnd::core
