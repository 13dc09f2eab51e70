#include "device/exoskeleton/mujoco_guard.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>
#include <mutex>

#include "core/error.h"

namespace jnd::device {
namespace {

// Where an error in a step of this thread jumps to. MuJoCo's step is plain C without anything
// to destroy, so a jump may leave it.
thread_local std::jmp_buf* step_escape = nullptr;

void on_error(const char* message) {
  if (step_escape != nullptr) std::longjmp(*step_escape, 1);
  throw core::Error("exoskeleton: expected MuJoCo to run, found its error \"" +
                    std::string(message) + "\"; report this as a bug");
}

void on_warning(const char*) {}  // Each warning also has a counter, which every step checks.

// MuJoCo keeps its handlers and the last loaded model for the whole process.
std::mutex& loading() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

void MujocoDeleter::operator()(mjModel_* model) const noexcept { mj_deleteModel(model); }
void MujocoDeleter::operator()(mjData_* data) const noexcept { mj_deleteData(data); }

MujocoModel load_mujoco_model(const std::string& xml) {
  const std::lock_guard lock(loading());
  static const bool installed = [] {
    mju_user_error = on_error;
    mju_user_warning = on_warning;
    return true;
  }();
  (void)installed;
  constexpr const char* kName = "exoskeleton.xml";
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  const int failed = mj_makeEmptyFileVFS(files.get(), kName, static_cast<int>(xml.size()));
  if (failed == 0) {
    void* text = files->filedata[mj_findFileVFS(files.get(), kName)];
    std::memcpy(text, xml.data(), xml.size());
  }
  char problem[500] = "no room for the model";
  MujocoModel model(failed == 0 ? mj_loadXML(kName, files.get(), problem, sizeof problem)
                                : nullptr);
  mj_freeLastXML();
  mj_deleteVFS(files.get());
  if (model == nullptr) {
    throw core::Error(
        "data/models/exoskeleton.xml: expected a model that MuJoCo can load, "
        "found: " +
        std::string(problem));
  }
  return model;
}

MujocoData make_mujoco_data(const mjModel_& model) {
  MujocoData data(mj_makeData(&model));
  if (data == nullptr) throw core::Error("exoskeleton: expected memory for its world");
  return data;
}

bool step_mujoco(const mjModel_& model, mjData_& data) noexcept {
  std::jmp_buf escape;
  step_escape = &escape;
  if (setjmp(escape) != 0) {
    step_escape = nullptr;
    return false;
  }
  mj_step(&model, &data);
  step_escape = nullptr;
  return std::all_of(data.warning, data.warning + mjNWARNING,
                     [](const mjWarningStat& stat) { return stat.number == 0; });
}

}  // namespace jnd::device
