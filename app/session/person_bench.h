#pragma once

#include <functional>
#include <iosfwd>
#include <string>

#include "device/exoskeleton/characterization.h"

namespace jnd::app {

/// A finger of a real device on which a person hangs weights and is told step by step what to
/// do. Every question is answered on `in`; an invalid answer is asked for again. Throws
/// `core::Error` if the answers end.
class PersonBench final : public device::FingerBench {
 public:
  /// Calls the given function with every sample of that many seconds.
  using Measure =
      std::function<void(double duration_s, const std::function<void(const core::Sample&)>&)>;

  /// `point` is the finger, as in `core::ContactPoint`. The streams have to outlive this
  /// object.
  PersonBench(std::istream& in, std::ostream& out, int point, int num_repetitions,
              Measure measure);

  [[nodiscard]] double break_away_weight_n(device::FingerPose pose, int repetition) override;
  [[nodiscard]] device::TorqueReading torques_under(device::FingerPose pose,
                                                    double weight_n) override;
  /// Tells the person what to do, in a sentence without its end, and waits for Enter.
  void wait_for(const std::string& what_to_do);

 private:
  [[nodiscard]] std::string next_line();

  std::istream& in_;
  std::ostream& out_;
  int point_;
  int num_repetitions_;
  Measure measure_;
};

}  // namespace jnd::app
