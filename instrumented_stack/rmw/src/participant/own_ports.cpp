// SPDX-License-Identifier: Apache-2.0
#include "participant/own_ports.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>

#include "fastdds_versions/transport.hpp"
#include "rcutils/logging.h"

namespace rmw_fastrtps {
namespace {

// The file that has the name of the port now; 0: none.
std::uint64_t file_of(std::uint32_t port) {
  struct stat status {};
  return stat(shared_memory_port_file(port).c_str(), &status) == 0 ? status.st_ino : 0;
}

// Whether this process has a file of the port in its memory, which may have lost its name.
bool is_mapped(std::uint32_t port, std::uint64_t file) {
  const std::string path = shared_memory_port_file(port);
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    std::istringstream words(line);
    std::string addresses, rights, offset, device, name;
    std::uint64_t inode = 0;
    if (words >> addresses >> rights >> offset >> device >> inode >> name && inode == file && name == path) {
      return true;
    }
  }
  return false;
}

// A file that has another name for a while. If there is a new file of its name then, it is gone.
class HiddenFile {
 public:
  explicit HiddenFile(const std::string& path) : path_(path) { std::rename(path_.c_str(), hidden_.c_str()); }
  HiddenFile(const HiddenFile&) = delete;
  HiddenFile& operator=(const HiddenFile&) = delete;
  ~HiddenFile() {
    [[maybe_unused]] const int result = ::link(hidden_.c_str(), path_.c_str());
    ::unlink(hidden_.c_str());
  }

 private:
  const std::string path_;
  const std::string hidden_ = path_ + "_hidden";
};

}  // namespace

void OwnPorts::opened(std::uint32_t port, std::function<void()> close, std::function<void()> open) {
  const std::lock_guard lock(mutex_);
  ports_.insert_or_assign(port, Port{std::move(close), std::move(open), file_of(port)});
}

void OwnPorts::closed(std::uint32_t port) {
  const std::lock_guard lock(mutex_);
  ports_.erase(port);
}

void OwnPorts::all_closed() {
  const std::lock_guard lock(mutex_);
  ports_.clear();
}

void OwnPorts::check(TimePoint now) {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock.owns_lock() || now < next_) {
    return;
  }
  next_ = now + kPatience;
  for (auto& [number, port] : ports_) {
    const std::uint64_t file = file_of(number);
    if (file == port.file && file != 0) {
      port.is_in_doubt = false;
    } else if (port.file != 0 && !is_mapped(number, port.file)) {
      // Fast DDS has opened the port again.
      port.file = file;
      port.is_in_doubt = false;
    } else if (!std::exchange(port.is_in_doubt, true)) {
      // Perhaps Fast DDS is about to do so.
    } else {
      rcutils_log(nullptr, RCUTILS_LOG_SEVERITY_DEBUG, "rmw_fastrtps",
                  "another process has taken port %u in shared memory away; it is opened again", number);
      {
        // Fast DDS removes what has the name of a port that it closes.
        const HiddenFile hidden(shared_memory_port_file(number));
        port.close();
      }
      port.open();
      port.file = file_of(number);
      port.is_in_doubt = false;
    }
  }
}

}  // namespace rmw_fastrtps
