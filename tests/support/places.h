#pragma once

#include <filesystem>

namespace jnd::test_support {

/// The tree that the tests were built from.
[[nodiscard]] std::filesystem::path source_folder();

/// The jnd program that was built with the tests.
[[nodiscard]] std::filesystem::path program_file();

/// The program that runs drivers, which was built with the tests.
[[nodiscard]] std::filesystem::path device_host_file();

}  // namespace jnd::test_support
