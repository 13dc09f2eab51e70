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

/// A stream of another program that we receive. Several threads may call it. Not real time.
class StreamInlet {
 public:
  enum class State {
    kConnecting,  ///< Nothing has arrived yet.
    kReceiving,
    kLost,  ///< The stream went away and may come back.
  };

  virtual ~StreamInlet() = default;

  /// Returns the samples that have arrived since the last call, in order, with times of the
  /// sender's clock.
  [[nodiscard]] virtual std::vector<StreamSample> take_samples() = 0;
  /// Returns the comparisons of the sender's clock with ours since the last call.
  [[nodiscard]] virtual std::vector<ClockOffset> take_offsets() = 0;
  [[nodiscard]] virtual const StreamInfo& info() const noexcept = 0;
  /// Returns all that the stream says about itself, as XML.
  [[nodiscard]] virtual const std::string& full_xml() const noexcept = 0;
  [[nodiscard]] virtual State state() const = 0;
  /// Returns a sentence that says why the stream is lost, or "" if it is not.
  [[nodiscard]] virtual std::string problem() const = 0;
  /// Returns the number of samples that arrived and were not taken in time.
  [[nodiscard]] virtual std::int64_t num_dropped() const = 0;
};

/// Opens an inlet of our own implementation to a stream that was found, by protocol 1.10, with
/// a thread of its own. It reconnects a broken connection. It looks for a lost stream with a
/// `source_id` again, because it may come back elsewhere. It asks for the description first,
/// and throws `Error` if that does not arrive within `timeout_s`.
[[nodiscard]] std::unique_ptr<StreamInlet> open_own_inlet(const StreamInfo& info,
                                                          const StreamNetwork& network,
                                                          double timeout_s = 5.0);

}  // namespace jnd::core
