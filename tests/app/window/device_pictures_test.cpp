#include "app/window/pictures_fixture.h"

namespace jnd::app {
namespace device_pictures_test {

class DevicePicturesTest : public PicturesWindowTest {};

TEST_F(DevicePicturesTest, OfADeviceThatIsCommissionedCheckedAndTried) {
  window_->start();
  window_->wait_for_view("start");
  window_->use("device");
  window_->wait_for_view("device");
  window_->use("change_device");
  window_->wait_for("address");
  take("device-choose");
  window_->press("ctrl+a");
  window_->type("twin:seed=7");
  window_->press("Return");
  window_->wait_for_text("twin:seed=7");
  window_->wait_for("measure");
  take("device-first");
  for (const char* next : {"Noise and resolution", "Frame, by touching marks"}) {
    window_->use("measure");
    window_->wait_for_text(next);
  }
  window_->use("rehearse");
  window_->use("measure");
  int num_asked = 0;
  while (num_asked < 5) {
    const std::vector<std::string> asked = window_->wait_for("done").texts;
    window_->use("done");
    window_->wait_until("the next question", [&](const Screen& now) {
      return now.offers("done") && now.texts != asked;
    });
    ++num_asked;
  }
  window_->wait_for("done");
  take("device-asks");
  window_->use("leave_off");
  window_->wait_for("rehearse");
  window_->use("rehearse");
  for (const char* next :
       {"Force, weight and friction", "Delay and mass", "Stability, by sweeps and stimuli"}) {
    window_->use("measure");
    window_->wait_for_text(next);
  }
  window_->use("measure");
  window_->wait_for("write_profile");
  take("device-measured");
  window_->use("write_profile");
  window_->wait_for_text("The profile is written");
  window_->use("page_daily");
  window_->use("check");
  window_->wait_for_text("Passed: the device is as its profile says");
  take("device-daily");
  window_->use("page_force");
  window_->use("push");
  window_->wait_for_text("moved it there");
  take("device-force");
  window_->use("page_watch");
  window_->use("watch");
  window_->wait_for_text("Enabling switch");
  take("device-watch");
  window_->use("leave_off");
  window_->wait_for("page_force");
  window_->use("page_force");
  window_->press("Escape");
  window_->wait_for("release_stop");
  take("device-stopped");
  window_->use("release_stop");
  window_->wait_for("push");
  close();
}

}  // namespace device_pictures_test
}  // namespace jnd::app
