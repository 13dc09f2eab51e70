#pragma once

#include <sys/mount.h>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace jnd::test_support {

/// Mounts a disk in memory with a limited size over an empty folder, and unmounts it after the
/// test. This needs the right to mount, and `mounted` says whether there was one.
class SmallDisk {
 public:
  SmallDisk(const std::filesystem::path& folder, int size_kib) : folder_(folder) {
    mounted_ =
        ::mount("tmpfs", folder_.c_str(), "tmpfs", 0, size_option(size_kib).c_str()) == 0;
  }
  ~SmallDisk() {
    if (mounted_) ::umount2(folder_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  [[nodiscard]] bool mounted() const noexcept { return mounted_; }
  [[nodiscard]] bool resize(int size_kib) const {
    return ::mount("tmpfs", folder_.c_str(), "tmpfs", MS_REMOUNT,
                   size_option(size_kib).c_str()) == 0;
  }
  [[nodiscard]] bool make_read_only() const {
    return ::mount("tmpfs", folder_.c_str(), "tmpfs", MS_REMOUNT | MS_RDONLY, "") == 0;
  }

 private:
  static std::string size_option(int size_kib) {
    return "size=" + std::to_string(size_kib) + "k";
  }

  std::filesystem::path folder_;
  bool mounted_ = false;
};

}  // namespace jnd::test_support
