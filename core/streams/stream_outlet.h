#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/stream_sample.h"
#include "core/streams/stream_info.h"
#include "core/streams/stream_network.h"

namespace jnd::core {

/// A stream that we offer to whoever records it. Safe to call from several threads. Never waits
/// for a consumer: what one that is too slow has not fetched is dropped, the oldest first, and
/// counted. Not real time.
class StreamOutlet {
 public:
  virtual ~StreamOutlet() = default;

  /// Samples in order, each with a value for every channel.
  virtual void push(const std::vector<StreamSample>& samples) = 0;
  /// As it is offered: with its identity, host and ports.
  [[nodiscard]] virtual const StreamInfo& info() const noexcept = 0;
  [[nodiscard]] virtual int num_consumers() const = 0;
  /// Samples that some consumer has lost because it was too slow.
  [[nodiscard]] virtual std::int64_t num_dropped() const = 0;
};

/// One of our own: by protocol 1.10, on a thread of its own. `seconds_kept`: how much of the
/// stream is kept for a consumer that is slow; of a stream without a rate a hundred samples for
/// each. What is still to be sent when it is destroyed is sent for a second at most. Throws
/// `Error` where the system has no port for it.
[[nodiscard]] std::unique_ptr<StreamOutlet> open_own_outlet(StreamInfo info,
                                                            const StreamNetwork& network,
                                                            double seconds_kept = 60.0);

}  // namespace jnd::core
