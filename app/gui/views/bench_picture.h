#pragma once

#include <string>
#include <vector>

#include "app/gui/ui.h"
#include "app/operator/device_view.h"

namespace jnd::app::gui {

/// What somebody does at a device, or what the device does by itself.
struct BenchPicture {
  enum class Scene {
    kRest,     ///< The tool rests on something firm.
    kHandOut,  ///< A hand leaves the tool.
    kMarks,    ///< The tool touches one of the marks of a box.
    kLetGo,    ///< The device holds its tool, and somebody steps back.
    kHang,     ///< Somebody hangs a weight on the tool.
    kTakeOff,  ///< Somebody takes the weight off.
    kMoves,    ///< The device moves to and fro; people keep away.
    kPushed,   ///< The device moves to and fro along one axis.
  };
  Scene scene = Scene::kRest;
  std::string load;                      ///< The words on the weight, such as "200 g".
  std::vector<Eigen::Vector3d> marks_m;  ///< All marks of the box.
  int mark = -1;                         ///< For `kMarks`, the mark to touch; -1 for none.
  int num_touched = 0;                   ///< How many marks before it are ticked.
  int axis = 0;                          ///< For `kPushed`, the axis: 0 is x, 1 is y, 2 is z.
};

/// Draws the scene in lines, as large as the place allows.
void draw_bench_picture(Ui& ui, const Rect& place, const BenchPicture& picture);

/// A picture of a step, for times when nobody is asked and nothing moves.
[[nodiscard]] BenchPicture picture_of_step(const DeviceView& view, std::size_t step);
/// A picture of what is asked for.
[[nodiscard]] BenchPicture picture_of_question(const std::vector<Eigen::Vector3d>& marks_m,
                                               const DeviceQuestion& question);

/// Where a mark is among the others: "left, far, low".
[[nodiscard]] std::string place_words(const std::vector<Eigen::Vector3d>& marks_m,
                                      const Eigen::Vector3d& mark_m);

}  // namespace jnd::app::gui
