// SPDX-License-Identifier: Apache-2.0
#include "registration/process_activity.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace tracetools {
namespace {

// A file of /proc, or "" if it cannot be read.
class ProcFile {
 public:
  ProcFile(pid_t process, pid_t thread, const char* name) {
    std::array<char, 96> path{};
    std::snprintf(path.data(), path.size(), "/proc/%d/task/%d/%s", process, thread, name);
    const int descriptor = open(path.data(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) {
      return;
    }
    const ssize_t length = read(descriptor, text_.data(), text_.size() - 1);
    length_ = length > 0 ? static_cast<std::size_t>(length) : 0;
    close(descriptor);
  }
  std::string_view text() const { return {text_.data(), length_}; }

 private:
  std::array<char, 4096> text_{};
  std::size_t length_ = 0;
};

// The number after the name; 0 if it is not there.
std::uint64_t number_after(std::string_view text, std::string_view name) {
  const std::size_t found = text.find(name);
  return found != std::string_view::npos ? std::strtoull(text.data() + found + name.size(), nullptr, 10) : 0;
}

}  // namespace

ProcessActivity::ProcessActivity(pid_t process) {
  look_at(process);
}

void ProcessActivity::add(const ProcessActivity& other) {
  stopped_ = stopped_ || other.stopped_;
  busy_ = busy_ || other.busy_;
  switches_ += other.switches_;
}

void ProcessActivity::look_at(pid_t process) {
  std::array<char, 64> path{};
  std::snprintf(path.data(), path.size(), "/proc/%d/task", process);
  DIR* const threads = opendir(path.data());
  if (threads == nullptr) {
    busy_ = true;
    return;
  }
  while (const dirent* const entry = readdir(threads)) {
    const pid_t thread = std::atoi(entry->d_name);
    if (thread <= 0 || thread == gettid()) {
      continue;
    }
    look_at_thread(process, thread);
    if (process != getpid()) {
      look_at_children(process, thread);
    }
  }
  closedir(threads);
}

void ProcessActivity::look_at_thread(pid_t process, pid_t thread) {
  const ProcFile status(process, thread, "status");
  constexpr std::string_view kState = "\nState:\t";
  const std::size_t state = status.text().find(kState);
  if (state == std::string_view::npos) {
    return;  // it has ended
  }
  const char letter = status.text()[state + kState.size()];
  busy_ = busy_ || letter == 'R' || letter == 'D';
  stopped_ = stopped_ || (thread == process && (letter == 'T' || letter == 't'));
  switches_ += number_after(status.text(), "\nvoluntary_ctxt_switches:\t") +
               number_after(status.text(), "\nnonvoluntary_ctxt_switches:\t");
}

void ProcessActivity::look_at_children(pid_t process, pid_t thread) {
  const ProcFile children(process, thread, "children");
  const char* at = children.text().data();
  for (char* end = nullptr;; at = end) {
    const pid_t child = static_cast<pid_t>(std::strtol(at, &end, 10));
    if (end == at) {
      return;
    }
    const ProcessActivity activity(child);
    busy_ = busy_ || activity.busy_;
    switches_ += activity.switches_;
  }
}

}  // namespace tracetools
