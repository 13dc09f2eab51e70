#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string_view>

namespace jnd::device {

/// What a program and a device share, and nobody else: whoever has it may command the device.
using DeviceKey = std::array<std::byte, 32>;

/// Where the user's keys are: in XDG_CONFIG_HOME/jnd, else ~/.config/jnd; "" without a home.
[[nodiscard]] std::filesystem::path device_keys_folder();

/// The file of the key of this name, "robot": letters, digits, "-" and "_". Throws
/// `core::Error` for another name, or where there is no folder. Not real time.
[[nodiscard]] std::filesystem::path device_key_file(std::string_view name);

/// Draws a key and writes it as 64 hexadecimal digits and a line's end, readable by the user
/// alone and on disk when this returns. Throws `core::Error` if the file is there already or
/// cannot be written. Not real time.
void make_device_key(const std::filesystem::path& file);

/// Throws `core::Error`: the file is not there, others may read it, or there is no key in it.
/// Not real time.
[[nodiscard]] DeviceKey read_device_key(const std::filesystem::path& file);

}  // namespace jnd::device
