// SPDX-License-Identifier: Apache-2.0
#include "registration/daemon_arrival.hpp"

#include <errno.h>
#include <fcntl.h>
#include <linux/futex.h>
#include <lttng/ust-ctl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

namespace tracetools {
namespace {

// The files of the daemon of root, and of the daemon of this process's user.
struct WakeFiles {
  const char* of_root;
  char of_user[64];

  WakeFiles() noexcept : of_root("/dev/shm/" LTTNG_UST_WAIT_FILENAME) {
    std::snprintf(of_user, sizeof of_user, "%s-%u", of_root, getuid());
  }
};

// Whether the file has memory of its own, and not only a size.
bool has_memory(const char* path) {
  struct stat status {};
  return stat(path, &status) == 0 && status.st_blocks > 0;
}

// lttng-ust 2.13, 2.16
constexpr bool kWakesAsKnown =
    LTTNG_UST_ABI_MAJOR_VERSION_OLDEST_COMPATIBLE == 8 || LTTNG_UST_ABI_MAJOR_VERSION_OLDEST_COMPATIBLE == 11;
constexpr const char* kFolderOfRoot = "/var/run/lttng";

bool socket_exists(const char* folder, const char* subfolder) {
  char path[4096];
  return std::snprintf(path, sizeof path, "%s%s/%s", folder, subfolder, LTTNG_UST_SOCK_FILENAME) >=
             static_cast<int>(sizeof path) ||
         access(path, F_OK) == 0;
}

// A daemon that was killed leaves its socket. Then it may be there, as far as we know.
bool daemon_may_be_there() {
  if (socket_exists(kFolderOfRoot, "")) {
    return true;
  }
  const char* const lttng_home = std::getenv("LTTNG_HOME");
  const char* const home = lttng_home != nullptr ? lttng_home : std::getenv("HOME");
  return home != nullptr && socket_exists(home, "/.lttng");
}

// LTTng's modes. Anyone may be the first who needs the file of root's daemon.
constexpr mode_t mode_of(bool of_root) {
  return of_root ? 0666 : 0640;
}

// With its mode and size from the beginning on, because others may open it at once.
void make_file(const char* path, bool of_root) {
  const int descriptor = open("/dev/shm", O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (descriptor < 0) {
    return;
  }
  char link[64];
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  if (fchmod(descriptor, mode_of(of_root)) == 0 && ftruncate(descriptor, sysconf(_SC_PAGESIZE)) == 0) {
    linkat(AT_FDCWD, link, AT_FDCWD, path, AT_SYMLINK_FOLLOW);  // if another process was first, its file is as good
  }
  close(descriptor);
}

int open_file(const char* path) {
  return open(path, O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
}

// Null if the daemon runs, or if this file can't tell.
const std::int32_t* map_number(const char* path, bool of_root) {
  int descriptor = open_file(path);
  if (descriptor < 0 && errno == ENOENT) {
    make_file(path, of_root);
    descriptor = open_file(path);
  }
  if (descriptor < 0) {
    return nullptr;
  }
  struct stat status {};
  std::int32_t number = 1;
  const std::int32_t* mapped = nullptr;
  // A file of another user is not the one that this user's daemon writes to.
  if (fstat(descriptor, &status) == 0 && (of_root || status.st_uid == getuid()) &&
      pread(descriptor, &number, sizeof number, 0) == sizeof number && number == 0) {
    void* const memory =
        mmap(nullptr, static_cast<std::size_t>(sysconf(_SC_PAGESIZE)), PROT_READ, MAP_SHARED, descriptor, 0);
    if (memory != MAP_FAILED) {
      mapped = static_cast<const std::int32_t*>(memory);
    }
  }
  close(descriptor);
  return mapped;
}

}  // namespace

std::optional<AwaitedDaemons> awaited_daemons() noexcept {
  // LTTng does not trace programs with the rights of another user by that user's daemon. Since 2.15 a variable may name
  // another folder for sockets, and for the file that wakes.
  if (!kWakesAsKnown || daemon_may_be_there() || getuid() != geteuid() ||
      std::getenv("LTTNG_UST_APP_PATH") != nullptr) {
    return std::nullopt;
  }
  const WakeFiles files;
  const bool is_root = getuid() == 0;
  const AwaitedDaemons daemons = {map_number(files.of_root, true),
                                  is_root ? nullptr : map_number(files.of_user, false)};
  if (daemons[0] == nullptr || (daemons[1] == nullptr && !is_root)) {
    return std::nullopt;
  }
  return daemons;
}

// The kernel reads the number: here it would raise SIGBUS if /dev/shm is full.
bool wait_for_daemon(const std::int32_t* number) noexcept {
  while (syscall(SYS_futex, number, FUTEX_WAIT, 0, nullptr, nullptr, 0) != 0) {
    if (errno == EAGAIN) {
      return true;  // it is not 0
    }
    if (errno != EINTR) {
      return false;
    }
  }
  return true;
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
