#pragma once

#include <memory>
#include <string>

struct mjModel_;
struct mjData_;

namespace jnd::device {

/// By itself MuJoCo ends the process at an error, writes warnings to a file in the current
/// folder, and resets a world in which a number becomes invalid. Behind this guard it does
/// neither of the first two, and the third is reported.

struct MujocoDeleter {
  void operator()(mjModel_* model) const noexcept;
  void operator()(mjData_* data) const noexcept;
};
using MujocoModel = std::unique_ptr<mjModel_, MujocoDeleter>;
using MujocoData = std::unique_ptr<mjData_, MujocoDeleter>;

/// Throws `core::Error` with MuJoCo's own words. Any thread. Not real time.
[[nodiscard]] MujocoModel load_mujoco_model(const std::string& xml);
/// Throws `core::Error`. Not real time.
[[nodiscard]] MujocoData make_mujoco_data(const mjModel_& model);

/// Makes one `mj_step`. Returns false if it raised an error, or a warning since the data were
/// reset; the state is then invalid. Real time.
[[nodiscard]] bool step_mujoco(const mjModel_& model, mjData_& data) noexcept;

}  // namespace jnd::device
