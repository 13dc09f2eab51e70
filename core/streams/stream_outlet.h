#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/stream_sample.h"
#include "core/streams/stream_info.h"
#include "core/streams/stream_network.h"

namespace jnd::core {

/// A stream that we offer to other recorders. Several threads may call it. It never waits for a
/// consumer: it drops the oldest samples that a slow one has not fetched, and counts them. Not
/// real time.
class StreamOutlet {
 public:
  virtual ~StreamOutlet() = default;

  /// Sends samples in order, each with a value for every channel.
  virtual void push(const std::vector<StreamSample>& samples) = 0;
  /// Returns the description as it is offered, with identity, host and ports.
  [[nodiscard]] virtual const StreamInfo& info() const noexcept = 0;
  [[nodiscard]] virtual int num_consumers() const = 0;
  /// Returns the number of samples that some consumer has lost because it was too slow.
  [[nodiscard]] virtual std::int64_t num_dropped() const = 0;
};

/// Opens an outlet of our own implementation, by protocol 1.10, with a thread of its own.
/// `seconds_kept` is how much of the stream is kept for a slow consumer; for a stream without a
/// rate this is a hundred samples for each second. The destructor sends the remaining samples
/// for a second at most. Throws `Error` if the system has no port for it.
[[nodiscard]] std::unique_ptr<StreamOutlet> open_own_outlet(StreamInfo info,
                                                            const StreamNetwork& network,
                                                            double seconds_kept = 60.0);

}  // namespace jnd::core
