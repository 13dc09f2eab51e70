#pragma once

#include <chrono>
#include <cstring>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "core/stream_sample.h"
#include "core/streams/stream_info.h"
#include "core/streams/stream_inlet.h"
#include "core/streams/stream_network.h"

namespace jnd::core {

/// Returns a network of this machine alone, so that nothing leaves it.
inline StreamNetwork loopback_network() {
  StreamNetwork network;
  network.groups.clear();
  network.peers = {"127.0.0.1"};
  network.session_id = "test-" + new_stream_uid();
  return network;
}

/// Whether it came about within ten seconds. Only a failure takes that long.
inline bool comes_about(const std::function<bool()>& holds) {
  for (int i = 0; i < 2000; ++i) {
    if (holds()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return holds();
}

/// Takes this many samples of an inlet, or those that came within ten seconds.
inline std::vector<StreamSample> take_from(StreamInlet& inlet, std::size_t count) {
  std::vector<StreamSample> all;
  (void)comes_about([&] {
    for (StreamSample& one : inlet.take_samples()) all.push_back(std::move(one));
    return all.size() >= count;
  });
  return all;
}

template <typename Number>
std::string raw(const std::vector<Number>& values) {
  std::string bytes(sizeof(Number) * values.size(), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

}  // namespace jnd::core
