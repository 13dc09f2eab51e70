#include "support/places.h"

namespace jnd::test_support {

std::filesystem::path source_folder() { return JND_SOURCE_DIR; }

std::filesystem::path program_file() { return JND_PROGRAM; }

std::filesystem::path device_host_file() { return JND_DEVICE_HOST_FILE; }

}  // namespace jnd::test_support
