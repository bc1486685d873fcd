// SPDX-License-Identifier: Apache-2.0
#include "registration/daemon_arrival.hpp"

#include <errno.h>
#include <fcntl.h>
#include <linux/futex.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "registration/wake_memory.hpp"

namespace tracetools {
namespace {

constexpr const char* kSocketName = "lttng-ust-sock-8";  // of lttng-ust 2.13
constexpr const char* kFolderOfRoot = "/var/run/lttng";

bool socket_exists(const char* folder, const char* subfolder) {
  char path[4096];
  return std::snprintf(path, sizeof path, "%s%s/%s", folder, subfolder, kSocketName) >= static_cast<int>(sizeof path) ||
         access(path, F_OK) == 0;
}

// A daemon that was killed leaves its socket. Then it may be there, as far as we know.
bool daemon_may_be_there() {
  if (socket_exists(kFolderOfRoot, "")) return true;
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
  if (descriptor < 0) return;
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
const void* map_number(const char* path, bool of_root) {
  int descriptor = open_file(path);
  if (descriptor < 0 && errno == ENOENT) {
    make_file(path, of_root);
    descriptor = open_file(path);
  }
  if (descriptor < 0) return nullptr;
  struct stat status {};
  std::int32_t number = 1;
  const void* mapped = nullptr;
  // A file of another user is not the one that this user's daemon writes to.
  if (fstat(descriptor, &status) == 0 && (of_root || status.st_uid == getuid()) &&
      pread(descriptor, &number, sizeof number, 0) == sizeof number && number == 0) {
    void* const memory =
        mmap(nullptr, static_cast<std::size_t>(sysconf(_SC_PAGESIZE)), PROT_READ, MAP_SHARED, descriptor, 0);
    if (memory != MAP_FAILED) mapped = memory;
  }
  close(descriptor);
  return mapped;
}

long wait_for_change(futex_waitv* numbers, unsigned int count) {
  return syscall(SYS_futex_waitv, numbers, count, 0, nullptr, 0);
}

// Linux 5.16 and later.
bool can_wait_for_two() {
  return wait_for_change(nullptr, 0) != 0 && errno == EINVAL;
}

}  // namespace

std::optional<DaemonArrival> DaemonArrival::awaited() noexcept {
  // LTTng does not trace programs with the rights of another user by that user's daemon.
  if (daemon_may_be_there() || getuid() != geteuid() || !can_wait_for_two()) return std::nullopt;
  const WakeFiles files;
  const std::array numbers = {map_number(files.of_root, true), map_number(files.of_user, false)};
  if (numbers[0] == nullptr || numbers[1] == nullptr) return std::nullopt;
  return DaemonArrival(numbers);
}

bool DaemonArrival::wait() const noexcept {
  std::array<futex_waitv, 2> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    numbers[i].uaddr = reinterpret_cast<std::uintptr_t>(numbers_[i]);
    numbers[i].flags = FUTEX_32;
  }
  // Each number is compared with 0 first. The call fails with EAGAIN if a daemon has written 1.
  long woken = 0;
  do {
    woken = wait_for_change(numbers.data(), numbers.size());
  } while (woken < 0 && errno == EINTR);
  return woken >= 0 || errno == EAGAIN;
}

}  // namespace tracetools
