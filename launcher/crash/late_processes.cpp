// SPDX-License-Identifier: Apache-2.0
#include "launcher/crash/late_processes.hpp"

#include <stdlib.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <istream>
#include <sstream>

#include "base/environment/own_prefix.hpp"
#include "base/files/unique_fd.hpp"
#include "launcher/crash/timed_command.hpp"

namespace launch {
namespace {

constexpr std::chrono::seconds kReaderWithin(20);

// A file of our own that goes away again.
class ScratchFile {
 public:
  ScratchFile() {
    path_ = (std::filesystem::temp_directory_path() / "launch-late-XXXXXX").string();
    if (const int fd = ::mkstemp(path_.data()); fd >= 0) {
      UniqueFd(fd).reset();
    }
  }
  ~ScratchFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace

std::map<pid_t, std::int64_t> late_processes(const std::filesystem::path& snapshot,
                                             const std::vector<std::string>& events, const std::atomic<bool>& hurry) {
  const ScratchFile csv;
  std::vector<std::string> command = {own_library_file("launch-trace-read"), snapshot.string(), "--format", "csv"};
  for (const std::string& event : events) {
    command.insert(command.end(), {"--event", event});
  }
  run_timed(command, csv.path(), kReaderWithin, &hurry);
  std::ifstream file(csv.path());
  return late_processes_of(file);
}

// time_ns,event,cpu_id,vpid,…; names of events hold no comma. Notes about losses may be among the lines.
std::map<pid_t, std::int64_t> late_processes_of(std::istream& csv) {
  std::map<pid_t, std::int64_t> found;
  for (std::string line; std::getline(csv, line);) {
    std::istringstream cells(line);
    std::string time;
    std::string name;
    std::string cpu;
    std::string pid;
    if (std::getline(cells, time, ',') && std::getline(cells, name, ',') && std::getline(cells, cpu, ',') &&
        std::getline(cells, pid, ',')) {
      const long number = std::strtol(pid.c_str(), nullptr, 10);
      if (number > 0) {
        std::int64_t& last = found[static_cast<pid_t>(number)];
        last = std::max<std::int64_t>(last, std::strtoll(time.c_str(), nullptr, 10));
      }
    }
  }
  return found;
}

}  // namespace launch
