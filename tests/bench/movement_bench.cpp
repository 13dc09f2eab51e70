#include <benchmark/benchmark.h>

#include <cmath>

#include "analysis/movement/movement_analysis.h"
#include "analysis/movement/recorded_study.h"
#include "core/random_stream.h"

namespace jnd::analysis {
namespace {

/// Measures the analysis of one participant's recording from end to end, on one core: read,
/// unpacked and measured. Argument 1 adds the 22 joints of an exoskeleton.
void movement_analysis(benchmark::State& state) {
  RecordedStudy study;
  core::RandomStream random(1, "movement bench");
  study.add("P01");
  for (int trial = 0; trial < 20; ++trial) {
    study.present({}, [&](core::Sample& sample) {
      for (auto& position : sample.tip_position_m) position[1] += random.normal(0.0, 1e-5);
      for (int joint = 0; state.range(0) == 1 && joint < core::kNumJoints; ++joint) {
        const double phase = 0.001 * static_cast<double>(sample.tick) + joint;
        sample.joint_position_rad[joint] = static_cast<float>(std::sin(6.28 * phase));
        sample.joint_torque_n_m[joint] = static_cast<float>(random.normal(0.0, 1e-3));
      }
      return true;
    });
  }
  study.finish();
  std::int64_t num_samples = 0;
  for (auto _ : state) {
    const MovementAnalysis movement = analyse_movement(study.store());
    num_samples += movement.participants[0].num_samples;
    if (movement.participants[0].find("group_d") == nullptr) state.SkipWithError("no strokes");
  }
  state.SetItemsProcessed(num_samples);
}
BENCHMARK(movement_analysis)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace jnd::analysis
