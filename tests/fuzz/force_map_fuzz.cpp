#include <cmath>
#include <string>

#include "core/error.h"
#include "core/media/force_map.h"
#include "experiments/protocol/force_map_file.h"
#include "fuzz/fuzz_check.h"

namespace {

using namespace jnd;

/// Expects that an accepted map gives numbers everywhere, and drag that never pushes.
void check_map(const core::ForceMap& map) {
  for (double angle_rad = -0.1; angle_rad < 1.7; angle_rad += 0.05) {
    for (const double speed_m_per_s : {0.0, 0.3, 1.0, 7.0, 1e300}) {
      const core::ForceMap::Coefficients at = map.at(angle_rad, speed_m_per_s);
      fuzz::property(at.drag >= 0.0 && at.drag <= 100.0 + 1e-9, "drag is within its rows");
      fuzz::property(std::abs(at.lift) <= 100.0 + 1e-9, "lift is within its rows");
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text = fuzz::text_of(data, size);
  try {
    check_map(experiments::parse_force_map(text, "x"));
  } catch (const core::Error& error) {
    fuzz::check_lines(error.what());
  }
  return 0;
}
