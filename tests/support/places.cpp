#include "support/places.h"

namespace jnd::test_support {

std::filesystem::path source_folder() { return JND_SOURCE_DIR; }

std::filesystem::path program_file() { return JND_PROGRAM; }

}  // namespace jnd::test_support
