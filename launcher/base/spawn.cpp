// SPDX-License-Identifier: Apache-2.0
#include "launcher/base/spawn.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <optional>

#include "launcher/base/process_mark.hpp"
#include "launcher/base/unique_fd.hpp"

namespace launch {
namespace {

void check(int error) {
  if (error != 0) {
    throw std::system_error(error, std::system_category(), "cannot prepare a process");
  }
}

class FileActions {
 public:
  explicit FileActions(const ChildProgram& child) {
    check(posix_spawn_file_actions_init(&actions_));
    try {
      add(child);
    } catch (...) {
      posix_spawn_file_actions_destroy(&actions_);
      throw;
    }
  }
  ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;

  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  void add(const ChildProgram& child) {
    for (const auto& [number, source] : child.descriptors) {
      if (source == kDevNull) {
        const int mode = number == STDIN_FILENO ? O_RDONLY : O_WRONLY;
        check(posix_spawn_file_actions_addopen(&actions_, number, "/dev/null", mode, 0));
      } else {
        check(posix_spawn_file_actions_adddup2(&actions_, source, number));
      }
    }
    if (child.only_standard_descriptors) {
      check(posix_spawn_file_actions_addclosefrom_np(&actions_, STDERR_FILENO + 1));
    }
    if (!child.directory.empty()) {
      check(posix_spawn_file_actions_addchdir_np(&actions_, child.directory.c_str()));
    }
  }

  posix_spawn_file_actions_t actions_;
};

class SpawnAttributes {
 public:
  explicit SpawnAttributes(const ChildProgram& child) {
    check(posix_spawnattr_init(&attributes_));
    int flags = 0;
    if (child.signals != ChildSignals::kInherited) {
      sigset_t blocked;
      child.signals == ChildSignals::kAllBlocked ? sigfillset(&blocked) : sigemptyset(&blocked);
      posix_spawnattr_setsigmask(&attributes_, &blocked);
      flags |= POSIX_SPAWN_SETSIGMASK;
    }
    if (child.signals == ChildSignals::kFresh) {
      sigset_t all;
      sigfillset(&all);
      posix_spawnattr_setsigdefault(&attributes_, &all);
      flags |= POSIX_SPAWN_SETSIGDEF;
    }
    if (child.group == ChildGroup::kOwn) {
      posix_spawnattr_setpgroup(&attributes_, 0);
      flags |= POSIX_SPAWN_SETPGROUP;
    } else if (child.group == ChildGroup::kOwnSession) {
      flags |= POSIX_SPAWN_SETSID;
    }
    posix_spawnattr_setflags(&attributes_, static_cast<short>(flags));
  }
  ~SpawnAttributes() { posix_spawnattr_destroy(&attributes_); }
  SpawnAttributes(const SpawnAttributes&) = delete;
  SpawnAttributes& operator=(const SpawnAttributes&) = delete;

  const posix_spawnattr_t* get() const { return &attributes_; }

 private:
  posix_spawnattr_t attributes_;
};

// A null-terminated array of C strings, as exec wants it.
class StringArray {
 public:
  explicit StringArray(const std::vector<std::string>& strings) {
    pointers_.reserve(strings.size() + 1);
    for (const std::string& string : strings) {
      pointers_.push_back(const_cast<char*>(string.c_str()));  // exec does not write, C has no way to say so
    }
    pointers_.push_back(nullptr);
  }
  StringArray(const std::map<std::string, std::string>& variables, const char* mark) {
    pointers_.reserve(variables.size() + 2);
    if (mark != nullptr) {
      pointers_.push_back(const_cast<char*>(mark));
    }
    std::size_t size = 0;
    for (const auto& [name, value] : variables) {
      size += name.size() + value.size() + 2;
    }
    text_.reserve(size);  // so that no pointer moves
    for (const auto& [name, value] : variables) {
      if (mark != nullptr && name == kMarkVariable) {
        continue;
      }
      pointers_.push_back(text_.data() + text_.size());
      text_.append(name).append("=").append(value).push_back('\0');
    }
    pointers_.push_back(nullptr);
  }
  StringArray(const StringArray&) = delete;
  StringArray& operator=(const StringArray&) = delete;

  char* const* get() const { return pointers_.data(); }

 private:
  std::string text_;
  std::vector<char*> pointers_;
};

std::string own_mark() {
  const char* const value = std::getenv(kMarkVariable);
  return value == nullptr ? std::string() : std::string(kMarkVariable) + "=" + value;
}

}  // namespace

SpawnError::SpawnError(int error, const std::string& program)
    : std::system_error(error, std::system_category(), fmt::format("cannot start '{}'", program)) {}

pid_t spawn(const ChildProgram& child) {
  const FileActions actions(child);
  const SpawnAttributes attributes(child);
  const StringArray argv(child.argv);
  std::optional<StringArray> variables;
  const std::string inherited_mark = child.mark.empty() ? own_mark() : std::string();
  const std::string& mark = child.mark.empty() ? inherited_mark : child.mark;
  if (child.environment != nullptr) {
    variables.emplace(*child.environment, mark.empty() ? nullptr : mark.c_str());
  }
  const auto start = child.search_path ? ::posix_spawnp : ::posix_spawn;
  pid_t pid = -1;
  const int error = start(&pid, child.program.c_str(), actions.get(), attributes.get(), argv.get(),
                          variables ? variables->get() : environ);
  if (error != 0) {
    throw SpawnError(error, child.program);
  }
  return pid;
}

int wait_for(pid_t pid) {
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

bool ends_within(pid_t pid, std::chrono::milliseconds limit) {
  const auto deadline = std::chrono::steady_clock::now() + limit;
  const UniqueFd pidfd(static_cast<int>(::syscall(SYS_pidfd_open, pid, 0)));
  if (!pidfd && errno == ESRCH) {
    return true;
  }
  pollfd ended{pidfd.get(), POLLIN, 0};
  while (true) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now()).count();
    const int ready = ::poll(&ended, 1, static_cast<int>(std::max<std::int64_t>(left, 0)));
    if (ready >= 0 || errno != EINTR) {
      return ready > 0;
    }
  }
}

}  // namespace launch
