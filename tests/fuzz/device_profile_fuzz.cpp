#include <string>

#include "core/error.h"
#include "experiments/device_profile/profile_reader.h"
#include "experiments/device_profile/profile_writer.h"
#include "fuzz/fuzz_check.h"

namespace {

using namespace jnd;

void check_profile(const experiments::DeviceProfile& profile) {
  const std::string text = experiments::device_profile_text(profile);
  fuzz::property(experiments::read_device_profile_text(text, "x") == profile,
                 "what is written is read as it was");
  fuzz::property(profile.limits.max_total_force_n <= 30.0, "no limit is above the program's");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text = fuzz::text_of(data, size);
  try {
    check_profile(experiments::read_device_profile_text(text, "x"));
  } catch (const core::Error& error) {
    fuzz::check_lines(error.what());
  }
  return 0;
}
