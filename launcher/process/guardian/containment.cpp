// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/guardian/containment.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/capability.h>
#include <sched.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/environment/home_directory.hpp"
#include "base/files/pipe.hpp"
#include "launcher/process/guardian/become_guardian.hpp"
#include "launcher/process/guardian/guardian_protocol.hpp"

namespace launch {
namespace {

// The first process tells how far it came. An empty step: everything is there.
struct SetUpReport {
  std::array<char, 60> step;
  int error;
};

struct Ends {
  UniqueFd outside;
  UniqueFd inside;
};

Ends make_ends() {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) {
    throw std::system_error(errno, std::system_category(), "socketpair");
  }
  return {UniqueFd(ends[0]), UniqueFd(ends[1])};
}

// In the first process of the namespace.
class First {
 public:
  explicit First(int reports) : reports_(reports) {}

  void set_up(bool user, uid_t uid, gid_t gid, pid_t number) const {
    if (user) {
      write_file("/proc/self/setgroups", "deny");
      write_file("/proc/self/uid_map", fmt::format("{0} {0} 1", uid));
      write_file("/proc/self/gid_map", fmt::format("{0} {0} 1", gid));
    }
    check("make mounts private", ::mount(nullptr, "/", nullptr, MS_REC | MS_SLAVE, nullptr));
    check("mount /proc", ::mount("proc", "/proc", "proc", MS_NOSUID | MS_NODEV | MS_NOEXEC, nullptr));
    give_own_session_daemon(uid);
    write_file("/proc/sys/kernel/ns_last_pid", std::to_string(number - 1));
  }

  // A session daemon of LTTng outside would see process numbers that are those of others there, and the launcher could
  // not look at it. So it finds none, and starts its own.
  void give_own_session_daemon(uid_t uid) const {
    constexpr const char* kOfRoot = "/run/lttng";
    if (uid == 0) {
      static_cast<void>(::mkdir(kOfRoot, 0755));
    } else {
      const char* const given = ::getenv("LTTNG_HOME");
      const std::string home = given != nullptr && *given != '\0' ? given : home_directory();
      const std::string own = home + "/.lttng";
      check("make a directory for LTTng", ::mkdir(own.c_str(), 0770) == 0 || errno == EEXIST ? 0 : -1);
      check("mount a directory for LTTng", ::mount("tmpfs", own.c_str(), "tmpfs", MS_NOSUID | MS_NODEV, "mode=0770"));
    }
    struct stat status {};
    if (::stat(kOfRoot, &status) == 0) {
      check("mount /run/lttng", ::mount("tmpfs", kOfRoot, "tmpfs", MS_NOSUID | MS_NODEV, "mode=0755"));
    }
  }

  void report(const char* step, int error) const {
    SetUpReport report{{}, error};
    fmt::format_to_n(report.step.data(), report.step.size() - 1, "{}", step);
    static_cast<void>(::send(reports_, &report, sizeof report, MSG_NOSIGNAL));
  }

 private:
  void check(const char* step, int result) const {
    if (result != 0) {
      report(step, errno);
      ::_exit(EXIT_FAILURE);
    }
  }

  void write_file(const char* path, std::string_view text) const {
    const UniqueFd file(::open(path, O_WRONLY | O_CLOEXEC));
    const bool written = file && ::write(file.get(), text.data(), text.size()) == static_cast<ssize_t>(text.size());
    check(path, written ? 0 : -1);
  }

  int reports_;
};

// In a user namespace a process has all capabilities until it becomes another program. The launcher needs none.
void drop_capabilities() {
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  std::array<__user_cap_data_struct, _LINUX_CAPABILITY_U32S_3> none{};
  ::syscall(SYS_capset, &header, none.data());
}

[[noreturn]] void fail_to_become(const std::string& program) {
  fmt::print(stderr, "launch: error: cannot start '{}': {}\n", program, std::strerror(errno));
  std::fflush(stderr);
  ::_exit(EXIT_FAILURE);
}

// fork(2) into a new namespace.
pid_t fork_into_namespace(bool user) {
  const unsigned long flags = CLONE_NEWPID | CLONE_NEWNS | (user ? CLONE_NEWUSER : 0) | SIGCHLD;
  return static_cast<pid_t>(::syscall(SYS_clone, flags, nullptr, nullptr, nullptr, nullptr));
}

// Throws std::system_error if the first process did not come up.
void wait_for_report(const UniqueFd& reports, pid_t first) {
  SetUpReport report{};
  const bool told = ::recv(reports.get(), &report, sizeof report, 0) == sizeof report;
  if (told && report.step[0] == '\0') {
    return;
  }
  ::waitpid(first, nullptr, 0);
  throw told ? std::system_error(report.error, std::system_category(), report.step.data())
             : std::system_error(ECHILD, std::system_category(), "the first process of the namespace");
}

Containment contain(const std::vector<std::string>& command_line, const std::string& program, bool user,
                    const sigset_t& before) {
  UniqueFd records = make_guardian_records();
  Pipe alive = make_pipe();
  Ends ends = make_ends();
  UniqueFd proc(::open("/proc", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  const uid_t uid = ::geteuid();
  const gid_t gid = ::getegid();
  const pid_t outside = ::getpid();
  const pid_t first = fork_into_namespace(user);
  if (first < 0) {
    throw std::system_error(errno, std::system_category(), "clone");
  }
  const auto words_of = [&](pid_t process, const UniqueFd& end, int pipe, const char* role) {
    return std::vector<std::string>{"launch-guardian",
                                    "contained",
                                    std::to_string(process),
                                    "-1",
                                    std::to_string(records.get()),
                                    std::to_string(end.get()),
                                    std::to_string(pipe),
                                    role};
  };
  if (first > 0) {
    ends.inside.reset();
    wait_for_report(ends.outside, first);
    std::vector<std::string> words = words_of(first, ends.outside, -1, kStandsOutside);
    words.insert(words.end(), command_line.begin(), command_line.end());
    become_guardian(program, words, {records.get(), ends.outside.get()});
    ::kill(first, SIGKILL);
    fail_to_become(program);
  }
  ends.outside.reset();
  const First set_up(ends.inside.get());
  set_up.set_up(user, uid, gid, outside);
  const pid_t guardian = ::fork();
  if (guardian == 0) {
    if (user) {
      drop_capabilities();
    }
    ::sigprocmask(SIG_SETMASK, &before, nullptr);
    return {std::move(records), std::move(proc), std::move(alive.write)};
  }
  if (guardian != outside) {
    set_up.report("choose a process number", guardian < 0 ? errno : EEXIST);
    ::_exit(EXIT_FAILURE);
  }
  set_up.report("", 0);
  alive.write.reset();
  become_guardian(program, words_of(guardian, ends.inside, alive.read.get(), kIsFirst),
                  {records.get(), ends.inside.get(), alive.read.get()});
  ::_exit(EXIT_FAILURE);
}

}  // namespace

Containment contain_this_process(const std::vector<std::string>& command_line, const std::string& program) {
  ::signal(SIGCHLD, SIG_DFL);
  // Two of the three read signals from a descriptor. Until then they wait.
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  ::sigprocmask(SIG_BLOCK, &all, &before);
  for (const bool user : {false, true}) {
    try {
      return contain(command_line, program, user, before);
    } catch (const std::system_error&) {
      if (user) {
        ::sigprocmask(SIG_SETMASK, &before, nullptr);
        throw;  // this is what a user without privileges may do, so its error tells more
      }
    }
  }
  ::_exit(EXIT_FAILURE);  // not reached
}

}  // namespace launch
