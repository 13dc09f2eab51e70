#pragma once

#include <string>
#include <vector>

#include "app/gui/ui.h"
#include "app/operator/device_view.h"

namespace jnd::app::gui {

/// What somebody does at a device, or what it does by itself.
struct BenchPicture {
  enum class Scene {
    kRest,     ///< The tool rests on something firm.
    kHandOut,  ///< A hand leaves it.
    kMarks,    ///< The tool at one of the marks of a box.
    kLetGo,    ///< The device holds its tool; somebody steps back.
    kHang,     ///< A weight on the tool.
    kTakeOff,  ///< The weight comes off.
    kMoves,    ///< It goes to and fro; keep away.
    kPushed,   ///< To and fro along one axis.
  };
  Scene scene = Scene::kRest;
  std::string load;                      ///< "200 g", on the weight.
  std::vector<Eigen::Vector3d> marks_m;  ///< All of the box.
  int mark = -1;                         ///< Of `kMarks`: the one to touch; -1: none.
  int num_touched = 0;                   ///< Marks before it, which are ticked.
  int axis = 0;                          ///< Of `kPushed`: x, y or z.
};

/// A drawing of it in lines, as large as the place allows.
void draw_bench_picture(Ui& ui, const Rect& place, const BenchPicture& picture);

/// What a step is about, while nobody is asked and nothing moves.
[[nodiscard]] BenchPicture picture_of_step(const DeviceView& view, std::size_t step);
/// What is asked for.
[[nodiscard]] BenchPicture picture_of_question(const std::vector<Eigen::Vector3d>& marks_m,
                                               const DeviceQuestion& question);

/// "left, far, low": where a mark is among the others.
[[nodiscard]] std::string place_words(const std::vector<Eigen::Vector3d>& marks_m,
                                      const Eigen::Vector3d& mark_m);

}  // namespace jnd::app::gui
