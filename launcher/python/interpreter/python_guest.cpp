// SPDX-License-Identifier: Apache-2.0
#include "launcher/python/interpreter/python_guest.hpp"

#include <errno.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <new>
#include <utility>

#include "base/files/unique_fd.hpp"
#include "base/monotonic_clock.hpp"
#include "base/processes/python_at_work.hpp"

namespace launch {

namespace {

// The parent looks at the guest this often. A look counts no more, so a command that was stopped (Ctrl-Z) loses no
// time.
constexpr std::chrono::milliseconds kLook{250};
// How long a guest may take to die after it was told to.
constexpr std::chrono::milliseconds kToDie{2000};

// Memory that guest and parent share.
struct Shared {
  std::atomic<bool> finished;       // the command has its result
  std::atomic<bool> lost_output;    // Python closed or replaced a standard descriptor
  std::atomic<std::uint64_t> call;  // counts the calls of Python; 0 while Python does not run
  std::array<char, 4096> name;      // of the call
};

struct Host {
  std::optional<GuestLimits> wanted;
  Shared* shared = nullptr;  // in a guest
  std::map<std::string, GuestRefusal> refused;
  std::uint64_t calls = 0;
  std::string name;  // of the call
  std::array<struct stat, 2> output{};
};

Host& host() {
  static auto* const one = new Host;
  return *one;
}

std::array<struct stat, 2> standard_output() {
  std::array<struct stat, 2> files{};
  ::fstat(STDOUT_FILENO, &files[0]);
  ::fstat(STDERR_FILENO, &files[1]);
  return files;
}

bool same(const struct stat& one, const struct stat& other) {
  return one.st_dev == other.st_dev && one.st_ino == other.st_ino;
}

// Limits what this process may have of private memory. RLIMIT_DATA, because libraries reserve addresses that they
// never use.
void limit_memory(std::uint64_t more) {
  std::ifstream file("/proc/self/statm");
  std::array<std::uint64_t, 6> pages{};  // the sixth is data and stack
  for (std::uint64_t& count : pages) {
    file >> count;
  }
  const rlim_t limit = pages[5] * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) + more;
  rlimit now{};
  ::getrlimit(RLIMIT_DATA, &now);
  now.rlim_cur = std::min(limit, now.rlim_max);
  ::setrlimit(RLIMIT_DATA, &now);
  const rlimit no_core = {};
  ::setrlimit(RLIMIT_CORE, &no_core);
}

enum class End { kByItself, kOutOfTime };

// Waits for the end of the guest. Ends it when one call of Python takes too long.
End watch(pid_t guest, const Shared& shared, std::chrono::nanoseconds limit) {
  const UniqueFd process(static_cast<int>(::syscall(SYS_pidfd_open, guest, 0)));
  pollfd event = {process.get(), POLLIN, 0};
  std::uint64_t call = 0;
  std::chrono::nanoseconds taken{0};
  for (std::int64_t last = monotonic_time();;) {
    if (::poll(&event, 1, static_cast<int>(kLook.count())) > 0) {
      return End::kByItself;
    }
    const std::int64_t now = monotonic_time();
    const std::chrono::nanoseconds look =
        std::min<std::chrono::nanoseconds>(std::chrono::nanoseconds(now - last), 2 * kLook);
    last = now;
    taken = shared.call == call && call != 0 ? taken + look : std::chrono::nanoseconds{0};
    call = shared.call;
    if (taken < limit) {
      continue;
    }
    ::kill(guest, SIGABRT);  // which tells where Python is
    if (::poll(&event, 1, static_cast<int>(kToDie.count())) == 0) {
      ::kill(guest, SIGKILL);
    }
    return End::kOutOfTime;
  }
}

std::string content(int descriptor) {
  std::string text(1U << 16U, '\0');
  const ssize_t count = ::pread(descriptor, text.data(), text.size(), 0);
  text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  return text;
}

GuestRefusal refusal_of(int status, End end, const Shared& shared, const GuestLimits& limits) {
  if (end == End::kOutOfTime) {
    return {fmt::format("Python runs here for more than {} s, and was ended", limits.time.count()), 0,
            "--python-seconds gives it more time"};
  }
  if (shared.lost_output) {
    return {"this file closes or replaces the standard output of the program that looks at it", 0, {}};
  }
  const std::string help = "it would end a launch in the same way";
  if (WIFSIGNALED(status)) {
    const char* const name = ::sigabbrev_np(WTERMSIG(status));
    return {fmt::format("Python ends here by SIG{}", name == nullptr ? std::to_string(WTERMSIG(status)) : name), 0,
            help};
  }
  return {fmt::format("Python ends the program here, with exit code {}", WEXITSTATUS(status)), 0, help};
}

bool comes_from_outside(int status) {
  if (!WIFSIGNALED(status)) {
    return false;
  }
  const int signal = WTERMSIG(status);
  return signal == SIGINT || signal == SIGTERM || signal == SIGHUP || signal == SIGQUIT || signal == SIGPIPE;
}

[[noreturn]] void end_like(int status) {
  if (WIFSIGNALED(status)) {
    const rlimit no_core = {};
    ::setrlimit(RLIMIT_CORE, &no_core);
    ::signal(WTERMSIG(status), SIG_DFL);
    ::raise(WTERMSIG(status));
  }
  ::_exit(WIFEXITED(status) ? WEXITSTATUS(status) : EXIT_FAILURE);
}

}  // namespace

void run_python_in_a_guest(const GuestLimits& limits) {
  host().wanted = limits;
}

void become_guest(void (*report_deaths)(int descriptor)) {
  Host& self = host();
  if (!self.wanted || self.shared != nullptr) {
    return;
  }
  void* const memory = ::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  UniqueFd traces(::memfd_create("launch_python_guest", MFD_CLOEXEC));
  if (memory == MAP_FAILED || !traces) {
    return;  // the machine is out of something: without a guest then
  }
  const pid_t parent = ::getpid();
  const auto interrupt = ::signal(SIGINT, SIG_IGN);  // the guest decides what follows from a Ctrl-C
  const auto quit = ::signal(SIGQUIT, SIG_IGN);
  for (;;) {
    auto* const shared = new (memory) Shared{};
    static_cast<void>(::ftruncate(traces.get(), 0));
    ::lseek(traces.get(), 0, SEEK_SET);
    std::fflush(nullptr);
    const pid_t guest = ::fork();
    if (guest <= 0) {
      ::signal(SIGINT, interrupt);
      ::signal(SIGQUIT, quit);
      if (guest < 0) {
        return;
      }
      ::prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (::getppid() != parent) {
        ::_exit(EXIT_FAILURE);
      }
      self.shared = shared;
      self.output = standard_output();
      limit_memory(self.wanted->memory);
      report_deaths(traces.get());
      static_cast<void>(traces.release());
      return;
    }
    const End end = watch(guest, *shared, self.wanted->time);
    int status = 0;
    while (::waitpid(guest, &status, 0) < 0 && errno == EINTR) {
    }
    const std::string name = shared->call == 0 ? std::string() : shared->name.data();
    if (shared->finished || comes_from_outside(status)) {
      end_like(status);
    }
    if (name.empty() || self.refused.contains(name)) {
      // A thread, or a function that Python calls at its end. No line is to blame.
      fmt::print(stderr, "launch: error: a Python launch file has ended the program that looks at it\n");
      end_like(WIFSIGNALED(status) ? status : EXIT_FAILURE << 8);
    }
    GuestRefusal refusal = refusal_of(status, end, *shared, *self.wanted);
    refusal.line = line_in_python_traces(content(traces.get()), name);
    self.refused.emplace(name, std::move(refusal));
  }
}

void end_of_guest() {
  end_of_watched_run();
  if (host().shared != nullptr) {
    host().shared->finished = true;
  }
}

std::optional<GuestLimits> guest_limits() {
  return host().shared == nullptr ? std::nullopt : host().wanted;
}

std::optional<GuestRefusal> guest_refusal(const std::string& name) {
  const auto found = host().refused.find(name);
  return found == host().refused.end() ? std::nullopt : std::optional(found->second);
}

std::optional<std::chrono::seconds> command_limit() {
  const std::optional<GuestLimits>& limits = host().wanted;
  return limits ? std::optional(limits->time) : watched_call_limit();
}

GuestCall::GuestCall(const std::string& name) : GuestCall(name, {.file = name}) {}

GuestCall::GuestCall(const std::string& name, PythonPlace place)
    : outer_(host().name), process_(::getpid()), watched_(std::move(place)) {
  Host& self = host();
  self.name = name;
  if (self.shared != nullptr) {
    ::strncpy(self.shared->name.data(), name.c_str(), self.shared->name.size() - 1);
    self.shared->call = ++self.calls;
  }
}

GuestCall::~GuestCall() {
  if (::getpid() != process_) {
    ::_exit(EXIT_SUCCESS);  // of os.fork(): what the command or the launch goes on with is not for this process
  }
  Host& self = host();
  self.name = outer_;
  if (self.shared == nullptr) {
    return;
  }
  const std::array<struct stat, 2> now = standard_output();
  if (!same(now[0], self.output[0]) || !same(now[1], self.output[1])) {
    self.shared->lost_output = true;
    ::_exit(EXIT_FAILURE);
  }
  ::strncpy(self.shared->name.data(), outer_.c_str(), self.shared->name.size() - 1);
  self.shared->call = outer_.empty() ? 0 : ++self.calls;
}

}  // namespace launch
