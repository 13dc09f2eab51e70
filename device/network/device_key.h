#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string_view>

namespace jnd::device {

/// A secret that only a program and a device share. Whoever has it may command the device.
using DeviceKey = std::array<std::byte, 32>;

/// Returns the folder of the user's keys: XDG_CONFIG_HOME/jnd, or ~/.config/jnd, or "" without
/// a home.
[[nodiscard]] std::filesystem::path device_keys_folder();

/// Returns the file of the key with this name, such as "robot": letters, digits, "-" and "_".
/// Throws `core::Error` for another name, or without a folder. Not real time.
[[nodiscard]] std::filesystem::path device_key_file(std::string_view name);

/// Draws a key and writes it as 64 hexadecimal digits and a line end. Only the user can read
/// the file, which is on disk when the function returns. Throws `core::Error` if the file
/// exists or cannot be written. Not real time.
void make_device_key(const std::filesystem::path& file);

/// Throws `core::Error` if the file is missing, if others may read it, or if it holds no key.
/// Not real time.
[[nodiscard]] DeviceKey read_device_key(const std::filesystem::path& file);

}  // namespace jnd::device
