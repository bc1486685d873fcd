// SPDX-License-Identifier: Apache-2.0
#include "participant/abandoned_memory.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace rmw_fastrtps {
namespace {

// Of Fast DDS 2 and 3, which both may have left files on this host.
constexpr std::string_view kPrefixes[] = {"fastrtps_", "fastdds_"};
constexpr std::string_view kPort = "port";
constexpr std::string_view kLock = "_el";
constexpr std::size_t kSegmentNumber = 16;  // characters
constexpr std::uint64_t kLastWellKnownPort = 65535;

bool consists_of(std::string_view text, std::string_view characters) {
  return !text.empty() && text.find_first_not_of(characters) == std::string_view::npos;
}

// A segment, or a port that was chosen at random. Of its name, without the prefix.
bool is_of_one_process(std::string_view name) {
  if (name.starts_with(kPort)) {
    const std::string port(name.substr(kPort.size()));
    return consists_of(port, "0123456789") && std::strtoull(port.c_str(), nullptr, 10) > kLastWellKnownPort;
  }
  return name.size() == kSegmentNumber && consists_of(name, "0123456789abcdefghijklmnopqrstuvwxyz");
}

// The name of the segment or port whose lock is the file `name`; "" if it is none that nobody uses again.
std::string locked_by(std::string_view name) {
  if (!name.ends_with(kLock)) {
    return {};
  }
  name.remove_suffix(kLock.size());
  for (const std::string_view prefix : kPrefixes) {
    if (name.starts_with(prefix) && is_of_one_process(name.substr(prefix.size()))) {
      return std::string(name);
    }
  }
  return {};
}

void remove_if_unlocked(int directory, const std::string& lock, const std::string& locked) {
  const int file = openat(directory, lock.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
  if (file < 0) {
    return;
  }
  if (flock(file, LOCK_EX | LOCK_NB) == 0) {
    unlinkat(directory, locked.c_str(), 0);
    unlinkat(directory, ("sem." + locked + "_mutex").c_str(), 0);  // ports have one
    unlinkat(directory, lock.c_str(), 0);
  }
  close(file);
}

}  // namespace

void remove_abandoned_memory(const std::string& path, std::chrono::seconds youngest) {
  DIR* const directory = opendir(path.c_str());
  if (directory == nullptr) {
    return;
  }
  const int folder = dirfd(directory);
  const time_t made_before = time(nullptr) - youngest.count();
  while (const dirent* const entry = readdir(directory)) {
    const std::string locked = locked_by(entry->d_name);
    struct stat status {};
    if (locked.empty() || fstatat(folder, entry->d_name, &status, AT_SYMLINK_NOFOLLOW) != 0) {
      continue;
    }
    if (!S_ISREG(status.st_mode) || status.st_uid != geteuid() || status.st_mtime > made_before) {
      continue;
    }
    remove_if_unlocked(folder, entry->d_name, locked);
  }
  closedir(directory);
}

}  // namespace rmw_fastrtps
