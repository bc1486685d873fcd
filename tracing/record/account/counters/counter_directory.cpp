// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/account/counters/counter_directory.hpp"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <fstream>
#include <mutex>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace tracing {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSharedMemory = "/dev/shm";
constexpr std::string_view kName = "launch-event-counters-";
constexpr std::string_view kSession = "session-";
// The guardian of a killed launcher reads the counts when the processes have ended, which takes seconds.
constexpr time_t kNobodyComesAnyMore = 600;  // seconds

// Of this user.
std::vector<fs::path> all_directories() {
  std::vector<fs::path> found;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(kSharedMemory, error)) {
    struct stat status {};
    if (!entry.path().filename().string().starts_with(kName)) {
      continue;
    }
    if (lstat(entry.path().c_str(), &status) != 0 || !S_ISDIR(status.st_mode) || status.st_uid != geteuid()) {
      continue;
    }
    found.push_back(entry.path());
  }
  return found;
}

launch::UniqueFd lock(const fs::path& directory, int how) {
  launch::UniqueFd opened(open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  if (opened && flock(opened.get(), how | LOCK_NB) != 0) {
    opened.reset();
  }
  return opened;
}

void remove_abandoned_directories() {
  for (const fs::path& directory : all_directories()) {
    struct stat status {};
    if (stat(directory.c_str(), &status) != 0 || time(nullptr) - status.st_mtime < kNobodyComesAnyMore) {
      continue;
    }
    std::error_code none;
    if (lock(directory, LOCK_EX)) {
      fs::remove_all(directory, none);
    }
  }
}

}  // namespace

std::shared_ptr<CounterDirectory> CounterDirectory::shared() {
  static std::mutex mutex;
  static std::weak_ptr<CounterDirectory> existing;
  const std::lock_guard guard(mutex);
  if (std::shared_ptr<CounterDirectory> directory = existing.lock()) {
    return directory;
  }
  remove_abandoned_directories();
  std::string path = (fs::path(kSharedMemory) / kName).string() + "XXXXXX";
  if (mkdtemp(path.data()) == nullptr) {
    return nullptr;
  }
  auto made = std::make_shared<CounterDirectory>(path);
  existing = made;
  return made;
}

std::string CounterDirectory::of_session(const std::string& name) {
  for (const fs::path& directory : all_directories()) {
    std::error_code none;
    if (fs::exists(directory / (std::string(kSession) + name), none)) {
      return directory.string();
    }
  }
  return {};
}

CounterDirectory::CounterDirectory(fs::path path) : path_(std::move(path)), in_use_(lock(path_, LOCK_SH)) {}

CounterDirectory::~CounterDirectory() {
  // Whatever a command line says.
  if (path_.parent_path() != kSharedMemory || !path_.filename().string().starts_with(kName)) {
    return;
  }
  std::error_code none;
  fs::remove_all(path_, none);
}

void note_session(const fs::path& counters, const std::string& name) {
  if (!counters.empty()) {
    std::ofstream(counters / (std::string(kSession) + name));
  }
}

}  // namespace tracing
