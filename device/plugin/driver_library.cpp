#include "device/plugin/driver_library.h"

#include <dlfcn.h>

#include "core/error.h"

namespace jnd::device {
namespace {

template <typename Function>
void look_up(void* library, const std::string& name, Function& function) {
  function = reinterpret_cast<Function>(::dlsym(library, name.c_str()));
  if (function != nullptr) return;
  throw core::Error("expected a driver with the function " + name +
                    ", found none; define every function of jnd_device.h, and in C++ include "
                    "it before you do");
}

}  // namespace

std::string text_in_sentence(const char* text) {
  constexpr std::size_t kMost = 200;
  std::string line;
  for (; text != nullptr && *text != '\0' && line.size() < kMost; ++text) {
    const auto letter = static_cast<unsigned char>(*text);
    line += letter >= 0x20 && letter < 0x7f ? static_cast<char>(letter) : ' ';
  }
  line.erase(line.find_last_not_of(" .") + 1);
  return line;
}

DriverLibrary::DriverLibrary(const std::filesystem::path& file) {
  void* library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    throw core::Error(
        "expected the shared object of a driver, found: " + text_in_sentence(::dlerror()) +
        "; build it with -shared -fPIC and all that it needs");
  }
  decltype(&jnd_device_abi) abi = nullptr;
  look_up(library, "jnd_device_abi", abi);
  if (const std::uint32_t version = abi(); version != JND_DEVICE_ABI) {
    throw core::Error("expected a driver of ABI version " + std::to_string(JND_DEVICE_ABI) +
                      ", found version " + std::to_string(version) +
                      "; build it with the jnd_device.h of this release");
  }
  look_up(library, "jnd_device_describe", describe);
  look_up(library, "jnd_device_open", open);
  look_up(library, "jnd_device_read", read);
  look_up(library, "jnd_device_write", write);
  look_up(library, "jnd_device_halt", halt);
  look_up(library, "jnd_device_close", close);
  look_up(library, "jnd_device_error", error);
}

}  // namespace jnd::device
