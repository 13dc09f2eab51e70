#pragma once

#include <string>
#include <vector>

namespace jnd::core {

/// What a session is asked to send to other recorders and to record of them; nothing unless
/// somebody asks.
struct WantedStreams {
  bool markers = false, samples = false;  ///< That go out.
  std::vector<std::string> channels;      ///< Of samples; empty: the usual ones.
  std::vector<std::string> inlets;  ///< "type=EEG": every stream of this kind is recorded.
  std::vector<std::string> peers;   ///< Machines that are asked by themselves.
  std::string library;              ///< A file of liblsl; "": our own carries them.

  [[nodiscard]] bool any() const noexcept { return markers || samples || !inlets.empty(); }
};

}  // namespace jnd::core
