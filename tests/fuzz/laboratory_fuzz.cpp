#include <cmath>
#include <string>

#include "core/error.h"
#include "experiments/participants/laboratory.h"
#include "fuzz/fuzz_check.h"

namespace {

using namespace jnd;
using experiments::Laboratory;

void check_laboratory(const Laboratory& laboratory, const std::string& text) {
  fuzz::property(laboratory.text == text, "a laboratory keeps its file word for word");
  for (const char* procedure : {"constant_stimuli", "a procedure of tomorrow"}) {
    const Laboratory::Strokes& strokes = laboratory.strokes_for(procedure);
    fuzz::property(strokes.strokes_per_presentation >= 1, "a hand strokes at least once");
    fuzz::property(std::isfinite(strokes.amplitude_m) && strokes.amplitude_m > 0.0,
                   "an amplitude is > 0");
  }
  fuzz::property(laboratory.device.mass_kg > 0.0, "a device has mass");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text = fuzz::text_of(data, size);
  try {
    check_laboratory(experiments::parse_laboratory(text, "x"), text);
  } catch (const core::Error& error) {
    fuzz::check_lines(error.what());
  }
  return 0;
}
