#pragma once

#include <filesystem>

namespace jnd::test_support {

/// Returns the source tree from which the tests were built.
[[nodiscard]] std::filesystem::path source_folder();

/// The jnd program that was built with the tests.
[[nodiscard]] std::filesystem::path program_file();

/// The program that runs drivers, which was built with the tests.
[[nodiscard]] std::filesystem::path device_host_file();

}  // namespace jnd::test_support
