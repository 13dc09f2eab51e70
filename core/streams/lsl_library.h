#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/streams/stream_inlet.h"
#include "core/streams/stream_outlet.h"

namespace jnd::core {

/// The library of the Lab Streaming Layer, if the user has installed and named one. It is
/// loaded when the program runs, and nothing of it is in the source tree. Its settings come
/// from its own files (lsl_api.cfg). Not real time.
class LslLibrary {
 public:
  /// Throws `Error` for a file that cannot be loaded or lacks a function.
  explicit LslLibrary(const std::string& file);
  ~LslLibrary();
  LslLibrary(const LslLibrary&) = delete;
  LslLibrary& operator=(const LslLibrary&) = delete;

  /// "liblsl 1.16 (/usr/lib/liblsl.so)"
  [[nodiscard]] const std::string& words() const noexcept { return words_; }

  struct Functions;
  [[nodiscard]] const Functions& functions() const noexcept { return *functions_; }
  /// Returns the difference of the library's clock from ours, which is 0 if it reads the same
  /// clock.
  [[nodiscard]] double clock_ahead_s() const noexcept { return clock_ahead_s_; }

 private:
  void* handle_ = nullptr;
  std::unique_ptr<Functions> functions_;
  std::string words_;
  double clock_ahead_s_ = 0.0;
};

/// These work like the functions of our own implementation; see `open_own_outlet`,
/// `find_streams` and `open_own_inlet`.
[[nodiscard]] std::unique_ptr<StreamOutlet> open_library_outlet(
    std::shared_ptr<const LslLibrary> library, const StreamInfo& info,
    double seconds_kept = 60.0);
[[nodiscard]] std::vector<StreamInfo> find_library_streams(const LslLibrary& library,
                                                           const std::string& query,
                                                           double timeout_s, int enough = 0);
[[nodiscard]] std::unique_ptr<StreamInlet> open_library_inlet(
    std::shared_ptr<const LslLibrary> library, const StreamInfo& info, double timeout_s = 5.0);

}  // namespace jnd::core
