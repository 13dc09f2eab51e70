#include "core/storage/writer_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/error.h"

namespace jnd::core {

WriterLock::WriterLock(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "writer.lock";
  descriptor_ = ::open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600);
  if (descriptor_ < 0) {
    throw Error(file.string() +
                ": expected a folder that can be written, found: " + std::strerror(errno));
  }
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    ::close(descriptor_);
    throw Error(folder.string() +
                ": expected to be the only program that writes to this study, found another "
                "one at work; close it first");
  }
}

WriterLock::~WriterLock() { ::close(descriptor_); }

}  // namespace jnd::core
