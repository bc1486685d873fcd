// SPDX-License-Identifier: Apache-2.0
#include "base/processes/spawn.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/close_range.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string_view>

#include "base/files/unique_fd.hpp"
#include "base/processes/process_mark.hpp"

// clone(3) under its other name: ThreadSanitizer puts a function of its own before the first one. That function takes
// the child for one with a memory of its own, and then looks at nothing more that the calling thread does.
extern "C" int __clone(int (*function)(void*), void* stack, int flags, void* argument, ...);  // NOLINT

namespace launch {
namespace {

constexpr int kNoProgram = 127;  // the exit code of a child without a program

// A signal's disposition as the kernel has it. All zero: the default.
struct KernelSignalAction {
  std::uintptr_t handler = 0;
  unsigned long flags = 0;
  std::uintptr_t restorer = 0;
  std::uint64_t mask = 0;
};
constexpr int kSignals = 64;
constexpr std::size_t kMaskSize = sizeof(std::uint64_t);
constexpr std::uint64_t kAllSignals = ~std::uint64_t{0};

// What the child needs between its birth and its program.
struct Birth {
  const ChildProgram& child;
  std::vector<ChildDescriptor> descriptors;
  std::vector<UniqueFd> out_of_the_way;  // copies of sources that another descriptor replaces
  std::vector<std::string> programs;     // to be tried one after the other
  char* const* argv;
  char* const* environment;
  std::vector<unsigned> kept;  // the numbers of its descriptors from 3 on, in order
  unsigned first_needless;     // no descriptor from here on is needed
  std::uint64_t mask;          // of signals
  bool shares_descriptors;     // it begins with the table of this process
  int error = 0;               // why it has no program
  bool stays_shared = false;   // the reason is that it can't get a table of its own
};

// The functions of the child run in the memory of this process, while the calling thread waits for it. So they make
// system calls and nothing else: the C library and sanitizers would take them for this process.
#define RUNS_IN_CHILD __attribute__((no_sanitize("address", "thread", "undefined")))

RUNS_IN_CHILD bool give_descriptors(const Birth& birth) {
  for (const ChildDescriptor& given : birth.descriptors) {
    if (given.source == kDevNull) {
      const int mode = given.number == STDIN_FILENO ? O_RDONLY : O_WRONLY;
      const long opened = ::syscall(SYS_openat, AT_FDCWD, "/dev/null", mode, 0);
      if (opened < 0 || (opened != given.number && ::syscall(SYS_dup3, opened, given.number, 0) < 0)) {
        return false;
      }
      if (opened != given.number) {
        ::syscall(SYS_close, opened);
      }
    } else if (given.source == given.number) {
      ::syscall(SYS_fcntl, given.number, F_SETFD, 0);
    } else if (::syscall(SYS_dup3, given.source, given.number, 0) < 0) {
      return false;
    }
  }
  if (birth.child.only_given_descriptors) {
    unsigned begin = STDERR_FILENO + 1;
    for (const unsigned number : birth.kept) {
      if (number > begin) {
        ::syscall(SYS_close_range, begin, number - 1, 0U);
      }
      begin = number + 1;
    }
    ::syscall(SYS_close_range, begin, ~0U, 0U);
  }
  return true;
}

// A handler of this process must not run in the child, and an ignored signal stays ignored in a program.
RUNS_IN_CHILD void set_signals(const Birth& birth) {
  const KernelSignalAction by_default;
  for (int signal = 1; signal <= kSignals; ++signal) {
    KernelSignalAction now;
    if (birth.child.signals != ChildSignals::kFresh) {
      ::syscall(SYS_rt_sigaction, signal, nullptr, &now, kMaskSize);
      if (now.handler <= reinterpret_cast<std::uintptr_t>(SIG_IGN)) {
        continue;
      }
    }
    ::syscall(SYS_rt_sigaction, signal, &by_default, nullptr, kMaskSize);
  }
}

RUNS_IN_CHILD int fail_in_child(Birth& birth) {
  birth.error = errno;
  ::syscall(SYS_exit_group, kNoProgram);
  return 0;
}

RUNS_IN_CHILD int be_born(void* data) {
  Birth& birth = *static_cast<Birth*>(data);
  if (birth.shares_descriptors && ::syscall(SYS_close_range, birth.first_needless, ~0U, CLOSE_RANGE_UNSHARE) != 0) {
    birth.stays_shared = true;
    return fail_in_child(birth);
  }
  set_signals(birth);
  const ChildGroup group = birth.child.group;
  const bool leads_session = group == ChildGroup::kOwnSession || group == ChildGroup::kOwnTerminal;
  if ((leads_session && ::syscall(SYS_setsid) < 0) ||
      (group == ChildGroup::kOwn && ::syscall(SYS_setpgid, 0, 0) != 0) || !give_descriptors(birth) ||
      (group == ChildGroup::kOwnTerminal && ::syscall(SYS_ioctl, STDIN_FILENO, TIOCSCTTY, 0) != 0) ||
      (!birth.child.directory.empty() && ::syscall(SYS_chdir, birth.child.directory.c_str()) != 0)) {
    return fail_in_child(birth);
  }
  if (birth.child.open_files) {
    ::syscall(SYS_prlimit64, 0, RLIMIT_NOFILE, &*birth.child.open_files, nullptr);
  }
  ::syscall(SYS_rt_sigprocmask, SIG_SETMASK, &birth.mask, nullptr, kMaskSize);
  bool is_refused = false;
  for (const std::string& program : birth.programs) {
    ::syscall(SYS_execve, program.c_str(), birth.argv, birth.environment);
    is_refused = is_refused || errno == EACCES;
    if (errno != ENOENT && errno != ENOTDIR && errno != EACCES) {
      break;
    }
  }
  errno = is_refused ? EACCES : errno;
  return fail_in_child(birth);
}

// Starts the child, which has its program, or an error, when this returns. Returns its number, or -1 and errno.
//
// A copy of all descriptors for each child, and their closing at exec, would make the start of a process slower with
// each process that a launcher has. So the child begins with the table of this process and takes along only what it
// needs. posix_spawn(3) can't do that.
pid_t give_birth(Birth& birth) {
  alignas(16) std::array<char, 32 * 1024> stack;  // not initialised: it is memory for the child
  const int files = birth.shares_descriptors ? CLONE_FILES : 0;
  std::uint64_t before = 0;
  ::syscall(SYS_rt_sigprocmask, SIG_SETMASK, &kAllSignals, &before, kMaskSize);
  if (birth.child.signals == ChildSignals::kInherited) {
    birth.mask = before;
  }
  const pid_t pid = ::__clone(be_born, stack.data() + stack.size(), CLONE_VM | CLONE_VFORK | files | SIGCHLD, &birth);
  const int error = errno;
  ::syscall(SYS_rt_sigprocmask, SIG_SETMASK, &before, nullptr, kMaskSize);
  errno = error;
  return pid;
}

// The paths that may be the program.
std::vector<std::string> programs_of(const ChildProgram& child) {
  if (!child.search_path || child.program.find('/') != std::string::npos) {
    return {child.program};
  }
  const char* const path = std::getenv("PATH");
  const std::string_view directories = path == nullptr ? "/usr/bin:/bin" : path;
  std::vector<std::string> programs;
  for (std::size_t begin = 0; begin <= directories.size();) {
    const std::size_t end = std::min(directories.find(':', begin), directories.size());
    const std::string directory(directories.substr(begin, end - begin));
    programs.push_back((directory.empty() ? "." : directory) + "/" + child.program);
    begin = end + 1;
  }
  return programs;
}

// A source whose number the child gets for something else would be replaced before it is given: standard descriptors of
// a program that was started without any, for example.
void move_sources_out_of_the_way(Birth& birth) {
  unsigned highest = STDERR_FILENO;
  for (const ChildDescriptor& given : birth.descriptors) {
    highest = std::max(highest, static_cast<unsigned>(given.number));
  }
  for (ChildDescriptor& given : birth.descriptors) {
    const bool is_replaced = std::any_of(birth.descriptors.begin(), birth.descriptors.end(), [&](const auto& other) {
      return other.number == given.source && given.number != given.source;
    });
    if (is_replaced) {
      birth.out_of_the_way.emplace_back(::fcntl(given.source, F_DUPFD_CLOEXEC, highest + 1));
      if (!birth.out_of_the_way.back()) {
        throw SpawnError(errno, birth.child.program);
      }
      given.source = birth.out_of_the_way.back().get();
    }
  }
}

Birth prepare_birth(const ChildProgram& child, char* const* argv, char* const* environment) {
  Birth birth{.child = child,
              .descriptors = child.descriptors,
              .out_of_the_way = {},
              .programs = programs_of(child),
              .argv = argv,
              .environment = environment,
              .kept = {},
              .first_needless = STDERR_FILENO + 1,
              .mask = child.signals == ChildSignals::kAllBlocked ? kAllSignals : 0,
              .shares_descriptors = child.only_given_descriptors};
  move_sources_out_of_the_way(birth);
  for (const ChildDescriptor& given : birth.descriptors) {
    if (given.number > STDERR_FILENO) {
      birth.kept.push_back(static_cast<unsigned>(given.number));
    }
    if (given.source != kDevNull) {
      birth.first_needless = std::max(birth.first_needless, static_cast<unsigned>(given.source) + 1);
    }
  }
  std::sort(birth.kept.begin(), birth.kept.end());
  return birth;
}

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
  const StringArray argv(child.argv);
  std::optional<StringArray> variables;
  const std::string inherited_mark = child.mark.empty() ? own_mark() : std::string();
  const std::string& mark = child.mark.empty() ? inherited_mark : child.mark;
  if (child.environment != nullptr) {
    variables.emplace(*child.environment, mark.empty() ? nullptr : mark.c_str());
  }
  // Old kernels, and containers that know no new system calls, need a copy of the descriptors.
  static std::atomic<bool> can_share = true;
  Birth birth = prepare_birth(child, argv.get(), variables ? variables->get() : environ);
  birth.shares_descriptors = birth.shares_descriptors && can_share;
  pid_t pid = give_birth(birth);
  if (pid >= 0 && birth.stays_shared) {
    can_share = false;
    wait_for(pid);
    birth.shares_descriptors = birth.stays_shared = false;
    birth.error = 0;
    pid = give_birth(birth);
  }
  if (pid < 0) {
    throw SpawnError(errno, child.program);
  }
  if (birth.error != 0) {
    wait_for(pid);
    throw SpawnError(birth.error, child.program);
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
