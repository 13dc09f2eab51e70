#include "device/plugin/driver_pages.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "core/error.h"

namespace jnd::device {
namespace {

[[noreturn]] void throw_no_memory() {
  throw core::Error("device plugin: expected memory to share with a driver, found: " +
                    std::string(std::strerror(errno)) + "; close other programs");
}

}  // namespace

MappedPage::MappedPage(int file, std::size_t size, bool writable)
    : memory_(::mmap(nullptr, size, writable ? PROT_READ | PROT_WRITE : PROT_READ, MAP_SHARED,
                     file, 0)),
      size_(size) {
  if (memory_ == MAP_FAILED) throw_no_memory();
}

MappedPage::~MappedPage() { ::munmap(memory_, size_); }

int make_page_file(const char* name, std::size_t size) {
  const int file = ::memfd_create(name, MFD_CLOEXEC | MFD_ALLOW_SEALING);
  if (file < 0) throw_no_memory();
  if (::ftruncate(file, static_cast<off_t>(size)) != 0 ||
      ::fcntl(file, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) != 0) {
    const int why = errno;
    ::close(file);
    errno = why;
    throw_no_memory();
  }
  return file;
}

}  // namespace jnd::device
