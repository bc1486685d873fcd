// SPDX-License-Identifier: Apache-2.0
#include "registration/wake_memory.hpp"

#include <lttng/ust-ctl.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cstdio>

namespace tracetools {
namespace {

// Whether the file has memory of its own, and not only a size.
bool has_memory(const char* path) {
  struct stat status {};
  return stat(path, &status) == 0 && status.st_blocks > 0;
}

}  // namespace

WakeFiles::WakeFiles() noexcept : of_root("/dev/shm/" LTTNG_UST_WAIT_FILENAME) {
  std::snprintf(of_user, sizeof of_user, "%s-%u", of_root, getuid());
}

bool wake_memory_can_be_had() noexcept {
  const WakeFiles files;
  const unsigned missing = (has_memory(files.of_root) ? 0U : 1U) + (has_memory(files.of_user) ? 0U : 1U);
  struct statvfs room {};
  // A file system without a limit has no number of blocks.
  if (missing == 0 || statvfs("/dev/shm", &room) != 0 || room.f_blocks == 0) {
    return true;
  }
  return room.f_bavail * room.f_frsize >= missing * static_cast<unsigned long>(sysconf(_SC_PAGESIZE));
}

}  // namespace tracetools
