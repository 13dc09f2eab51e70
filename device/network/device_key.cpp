#include "device/network/device_key.h"

#include <fcntl.h>
#include <openssl/rand.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>

#include "core/error.h"

namespace jnd::device {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kHexDigits = "0123456789abcdef";
constexpr std::size_t kNumDigits = 2 * std::tuple_size_v<DeviceKey>;

std::string hexadecimal(const DeviceKey& key) {
  std::string digits;
  for (const std::byte byte : key) {
    digits += kHexDigits[std::to_integer<std::size_t>(byte >> 4)];
    digits += kHexDigits[std::to_integer<std::size_t>(byte & std::byte{15})];
  }
  return digits;
}

/// A file that is always closed.
class OpenFile {
 public:
  OpenFile(const fs::path& file, int flags)
      : descriptor_(::open(file.c_str(), flags | O_CLOEXEC, 0600)) {}
  ~OpenFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  [[nodiscard]] int descriptor() const noexcept { return descriptor_; }

 private:
  int descriptor_;
};

}  // namespace

fs::path device_keys_folder() {
  const char* config = std::getenv("XDG_CONFIG_HOME");
  if (config != nullptr && *config == '/') return fs::path(config) / "jnd" / "device-keys";
  const char* home = std::getenv("HOME");
  if (home == nullptr || *home != '/') return {};
  return fs::path(home) / ".config" / "jnd" / "device-keys";
}

fs::path device_key_file(std::string_view name) {
  const bool is_name =
      !name.empty() && name.size() <= 64 &&
      std::all_of(name.begin(), name.end(), [](unsigned char letter) {
        return letter < 0x80 && (std::isalnum(letter) != 0 || letter == '-' || letter == '_');
      });
  if (!is_name) {
    throw core::Error(
        R"(device key: expected a name of letters, digits, "-" and "_", found ")" +
        std::string(name.substr(0, 80)) + '"');
  }
  const fs::path folder = device_keys_folder();
  if (folder.empty()) {
    throw core::Error(
        "device key: expected a home folder to keep keys in, found none; set HOME or "
        "XDG_CONFIG_HOME");
  }
  return folder / (std::string(name) + ".key");
}

void make_device_key(const fs::path& file) {
  DeviceKey key;
  if (::RAND_bytes(reinterpret_cast<unsigned char*>(key.data()),
                   static_cast<int>(key.size())) != 1) {
    throw core::Error("device key: expected random numbers of the system, found none");
  }
  std::error_code ignored;
  fs::create_directories(file.parent_path(), ignored);
  const std::string text = hexadecimal(key) + "\n";
  const OpenFile open(file, O_WRONLY | O_CREAT | O_EXCL);
  if (open.descriptor() < 0) {
    const int error = errno;
    throw core::Error(file.string() +
                      (error == EEXIST
                           ? ": expected no key of this name yet, found one; choose another "
                             "name, or remove it on both machines"
                           : std::string(": expected to be able to write it, found: ") +
                                 std::strerror(error)));
  }
  if (::write(open.descriptor(), text.data(), text.size()) !=
          static_cast<ssize_t>(text.size()) ||
      ::fsync(open.descriptor()) != 0) {
    const std::string why = std::strerror(errno);
    fs::remove(file, ignored);
    throw core::Error(file.string() + ": expected to be able to write it, found: " + why);
  }
  const OpenFile folder(file.parent_path(), O_RDONLY | O_DIRECTORY);
  if (folder.descriptor() >= 0) (void)::fsync(folder.descriptor());
}

DeviceKey read_device_key(const fs::path& file) {
  const OpenFile open(file, O_RDONLY);
  if (open.descriptor() < 0) {
    const std::string why = std::strerror(errno);
    throw core::Error(file.string() + ": expected a device key, found: " + why +
                      "; make one with `jnd device-key " + file.stem().string() +
                      "` and copy the file to the other machine");
  }
  struct stat status {};
  const bool is_known = ::fstat(open.descriptor(), &status) == 0;
  if (!is_known || status.st_uid != ::geteuid()) {
    throw core::Error(
        file.string() +
        ": expected a key of one's own, found a file of somebody else; make a new "
        "one on both machines");
  }
  if ((status.st_mode & 077) != 0) {
    throw core::Error(file.string() +
                      ": expected a key that its owner alone may read, found that others may; "
                      "make a new one if anybody has, and run chmod 600 on the file");
  }
  std::array<char, kNumDigits + 2> text{};
  const ssize_t size = ::read(open.descriptor(), text.data(), text.size());
  const bool is_whole =
      size == static_cast<ssize_t>(kNumDigits) ||
      (size == static_cast<ssize_t>(kNumDigits + 1) && text[kNumDigits] == '\n');
  DeviceKey key{};
  bool is_hexadecimal = is_whole;
  for (std::size_t i = 0; is_whole && i < kNumDigits; ++i) {
    const std::size_t digit = kHexDigits.find(text[i]);
    is_hexadecimal &= digit != std::string_view::npos;
    key[i / 2] = key[i / 2] << 4 | static_cast<std::byte>(digit & 15);
  }
  if (!is_hexadecimal) {
    throw core::Error(file.string() + ": expected " + std::to_string(kNumDigits) +
                      " hexadecimal digits, found something else; copy the file again");
  }
  return key;
}

}  // namespace jnd::device
