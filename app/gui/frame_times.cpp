#include "app/gui/frame_times.h"

#include <array>
#include <cstdio>
#include <ctime>

#include "core/error.h"

namespace jnd::app::gui {
namespace {

double process_cpu_ms() {
  timespec used{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
  return 1e3 * static_cast<double>(used.tv_sec) + 1e-6 * static_cast<double>(used.tv_nsec);
}

}  // namespace

FrameTimes::FrameTimes(const std::filesystem::path& file) {
  if (file.empty()) return;
  out_.open(file, std::ios::app);
  if (!out_) {
    throw core::Error(file.string() +
                      ": expected a file that can be written, as JND_FRAME_TIMES names it, "
                      "found none; choose another one");
  }
}

void FrameTimes::begin_frame() {
  if (!wanted()) return;
  cpu_began_ms_ = process_cpu_ms();
  part_began_ = std::chrono::steady_clock::now();
}

void FrameTimes::end(Part part) {
  if (!wanted()) return;
  const auto now = std::chrono::steady_clock::now();
  ms_[static_cast<std::size_t>(part)] =
      std::chrono::duration<double, std::milli>(now - part_began_).count();
  part_began_ = now;
}

void FrameTimes::end_frame(std::string_view view) {
  if (!wanted()) return;
  std::array<char, 96> numbers{};
  std::snprintf(numbers.data(), numbers.size(), " %.3f %.3f %.3f %.3f", ms_[0], ms_[1], ms_[2],
                process_cpu_ms() - cpu_began_ms_);
  out_ << view << numbers.data() << std::endl;
}

}  // namespace jnd::app::gui
