#include "app/commissioning/asked_bench.h"

#include <fmt/format.h>

namespace jnd::app {

void AskedBench::take_hand_out() { ask_("Take every hand out of the device."); }

void AskedBench::home() {
  ask_(
      "Home the device as its maker says, by its maker's program if that takes one: nothing "
      "here "
      "holds the device meanwhile. Then rest its tool where it rested before.");
}

void AskedBench::clamp() {
  if (!is_held_) ask_("Hold the tool where it is, or let it rest on something.");
  is_held_ = true;
}

void AskedBench::expect_force() {
  if (!is_held_) return;
  ask_(
      "Go on holding the tool where it is, fingers clear of its links: the device will "
      "hold it, too, by a force that grows from nothing within half a second.");
}

void AskedBench::touch(const Eigen::Vector3d& mark_m) {
  ask_(fmt::format(
      "Bring the first contact point to the mark at x {:.0f}, y {:.0f}, z {:.0f} mm, "
      "and hold it there.",
      1e3 * mark_m.x(), 1e3 * mark_m.y(), 1e3 * mark_m.z()));
}

void AskedBench::let_go() {
  if (is_held_) ask_("The device holds the tool by its own force now: let go of it.");
  is_held_ = false;
}

void AskedBench::let_go_without_force() {
  ask_(
      "The device has no force now: take the support away, let go of the tool for a moment, "
      "and "
      "be ready to catch it.");
  is_held_ = false;
}

void AskedBench::hang(double load_kg) {
  ask_(load_kg > 0.0 ? fmt::format("Hang {:.0f} g from the tool.", 1e3 * load_kg)
                     : std::string("Take the load off the tool."));
}

}  // namespace jnd::app
