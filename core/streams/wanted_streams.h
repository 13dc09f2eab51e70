#pragma once

#include <string>
#include <vector>

namespace jnd::core {

/// What a session sends to other recorders and records from them; nothing by default.
struct WantedStreams {
  bool markers = false, samples = false;  ///< Streams that are sent.
  std::vector<std::string> channels;      ///< Channels of samples; empty means the usual ones.
  std::vector<std::string> inlets;        ///< "type=EEG" records every stream of this type.
  std::vector<std::string> peers;         ///< Machines that are asked individually.
  std::string library;                    ///< A file of liblsl; "" uses our own implementation.

  [[nodiscard]] bool any() const noexcept { return markers || samples || !inlets.empty(); }
};

}  // namespace jnd::core
