#include <unistd.h>

#include <array>
#include <cerrno>
#include <ctime>
#include <utility>

#include "core/controls/control_source.h"
#include "core/error.h"
#include "core/markers/serial_port.h"

namespace jnd::core {
namespace {

class SerialBox final : public ControlSource {
 public:
  SerialBox(const std::filesystem::path& path, int baud)
      : port_(path, baud), name_("serial " + path.string()) {}

  [[nodiscard]] const std::string& device() const noexcept override { return name_; }
  [[nodiscard]] int descriptor() const noexcept override { return port_.descriptor(); }

  [[nodiscard]] std::vector<ControlEvent> take() override {
    std::array<unsigned char, 64> bytes;
    const ssize_t count = ::read(descriptor(), bytes.data(), bytes.size());
    timespec now{};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    const std::int64_t now_ns = now.tv_sec * std::int64_t{1'000'000'000} + now.tv_nsec;
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) return {};
    if (count <= 0) {
      throw Error(name_ + ": expected bytes, found that the box is gone; plug it in again");
    }
    std::vector<ControlEvent> events;
    for (ssize_t i = 0; i < count; ++i) {
      const Control control{name_,
                            "byte " + std::to_string(bytes[static_cast<std::size_t>(i)])};
      events.push_back({control, true, now_ns});
      events.push_back({control, false, now_ns});
    }
    return events;
  }

  /// A serial box is exclusively ours from its opening on.
  [[nodiscard]] bool take_for_ourselves(bool) override { return true; }

 private:
  SerialPort port_;
  std::string name_;
};

}  // namespace

std::unique_ptr<ControlSource> open_serial_box(const std::filesystem::path& path, int baud) {
  return std::make_unique<SerialBox>(path, baud);
}

}  // namespace jnd::core
