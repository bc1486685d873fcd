// SPDX-License-Identifier: Apache-2.0
// launch-kernel-recorder INSTANCE DIRECTORY
//     [event NAME FILTER | syscall NAME | context FIELD | leave-out PROCESS | snapshots]…
//
// Records events of the kernel into DIRECTORY until it gets SIGTERM, without modules of LTTng. SIGUSR1 pauses it, with
// everything written; SIGUSR2 lets it go on. It prints "ready" once it records, or "error: …" and "hint: …", and closes
// its output. While it runs, DIRECTORY/../kernel-recorder.pid holds its process id, the time of its start in clock
// ticks after the boot, and its state, "recording" or "paused"; a new file replaces this file when the state changes.
// At the end it writes to kernel-recorder.json there what it has recorded and lost. A name that the kernel hasn't is
// skipped, with a "warning: …" after "ready"; if the kernel has none of the names, that is an error. (Readers of CTF
// take every file of DIRECTORY for a stream.)
//
// With `snapshots` it writes nothing into DIRECTORY: the kernel's buffers keep the newest events. When it gets SIGRTMIN
// it reads DIRECTORY/../kernel-recorder.request, which has a directory and on the next line "keep" or "clear". It then
// writes to `kernel` in that directory what the buffers hold and what earlier snapshots have kept. With "clear" the
// next snapshot begins after this one. Its state is then the name of that directory, or "failed" with the reason.
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "base/files/replace_file.hpp"
#include "base/processes/process_stat.hpp"
#include "tracing/record/kernel/ctf_writer.hpp"
#include "tracing/record/kernel/ring_page.hpp"
#include "tracing/record/kernel/snapshot_writer.hpp"
#include "tracing/record/kernel/thread_table.hpp"
#include "tracing/record/kernel/tracefs.hpp"

namespace {

namespace fs = std::filesystem;
using namespace tracing::kernel;

constexpr std::size_t kLargestPage = 65536;  // sub-buffers can be made larger than a page since Linux 6.8

// A page that is read may be part-full, and one more page than the buffer has belongs to the reader.
constexpr std::size_t kPagesOfABuffer = 2 * TracefsInstance::kBufferBytes / 4096;

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) {
      close(fd_);
    }
  }
  int get() const { return fd_; }

 private:
  int fd_;
};

struct RingBuffer {
  unsigned cpu;
  Descriptor file;
};

// The signals are blocked from the beginning and read from a descriptor.
int control_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGUSR1, SIGUSR2, SIGRTMIN}) {
    sigaddset(&signals, signal);
  }
  sigprocmask(SIG_BLOCK, &signals, nullptr);
  return signalfd(-1, &signals, SFD_CLOEXEC);
}

std::vector<RingBuffer> open_buffers(const TracefsInstance& instance) {
  std::vector<RingBuffer> buffers;
  for (const auto& [cpu, path] : instance.ring_buffers()) {
    Descriptor file(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    if (file.get() < 0) {
      throw KernelTraceError(fmt::format("cannot read {}: {}", path.string(), std::strerror(errno)));
    }
    buffers.push_back({cpu, std::move(file)});
  }
  return buffers;
}

// Calls take(cpu, page) for the pages that are there, of all processors. Not for more than the buffers hold: under load
// pages come as fast as they are read, and the recorder must look at its signals in between.
template <class Take>
void read_buffers(const std::vector<RingBuffer>& buffers, Take&& take) {
  static std::array<std::uint8_t, kLargestPage> page;
  for (const RingBuffer& buffer : buffers) {
    for (std::size_t pages = 0; pages < kPagesOfABuffer; ++pages) {
      const ssize_t length = read(buffer.file.get(), page.data(), page.size());
      if (length <= 0) {
        break;
      }
      take(buffer.cpu, std::vector<std::uint8_t>(page.begin(), page.begin() + length));
    }
  }
}

void learn(ThreadTable& threads, std::span<const std::uint8_t> page) {
  read_ring_page(page, [&](std::uint64_t time, std::span<const std::uint8_t> record) { threads.learn(time, record); });
}

// The table of threads learns from all pages before any page is written.
void drain(const std::vector<RingBuffer>& buffers, CtfWriter& writer, ThreadTable& threads) {
  std::vector<std::pair<unsigned, std::vector<std::uint8_t>>> pages;
  read_buffers(buffers,
               [&](unsigned cpu, std::vector<std::uint8_t> page) { pages.emplace_back(cpu, std::move(page)); });
  for (const auto& [cpu, bytes] : pages) {
    learn(threads, bytes);
  }
  for (const auto& [cpu, bytes] : pages) {
    writer.write_page(cpu, bytes);
  }
  threads.forget_the_past();
}

struct Options {
  std::vector<std::string> context_fields;
  bool snapshots = false;
  std::string warning;  // the names that the kernel hasn't
};

Options enable(TracefsInstance& instance, int argc, char** argv) {
  Options options;
  // What the recorder does for its own sake would make events as fast as it reads them.
  std::vector<std::string> left_out = {"self"};
  std::optional<UnknownNameError> unknown;
  // `name` is the form in which the warning shows it.
  const auto pass_over_unknown = [&](const std::string& name, const auto& enable_it) {
    try {
      enable_it();
    } catch (const UnknownNameError& error) {
      if (!unknown) {
        unknown = error;
      }
      options.warning += (options.warning.empty() ? "not recorded, for the kernel has no " : ", no ") + name;
    }
  };
  for (int i = 3; i < argc;) {
    const std::string kind = argv[i];
    if (kind == "event" && i + 2 < argc) {
      pass_over_unknown(fmt::format("event '{}'", argv[i + 1]),
                        [&] { instance.enable_event(argv[i + 1], argv[i + 2]); });
      i += 3;
    } else if (kind == "syscall" && i + 1 < argc) {
      pass_over_unknown(fmt::format("system call '{}'", argv[i + 1]), [&] { instance.enable_syscall(argv[i + 1]); });
      i += 2;
    } else if (kind == "context" && i + 1 < argc) {
      options.context_fields.emplace_back(argv[i + 1]);
      i += 2;
    } else if (kind == "leave-out" && i + 1 < argc) {
      left_out.emplace_back(argv[i + 1]);
      i += 2;
    } else if (kind == "snapshots") {
      options.snapshots = true;
      i += 1;
    } else {
      throw KernelTraceError("launch-kernel-recorder: bad arguments");
    }
  }
  if (unknown && instance.formats().empty()) {
    throw UnknownNameError(*unknown);
  }
  instance.leave_out(left_out);
  return options;
}

void say(const std::string& text) {
  fmt::print("{}", text);
  std::fflush(stdout);
  // A reader of our output waits for its end.
  const Descriptor null(open("/dev/null", O_WRONLY | O_CLOEXEC));
  dup2(null.get(), STDOUT_FILENO);
}

std::string ready(const Options& options) {
  return options.warning.empty() ? "ready\n" : fmt::format("ready\nwarning: {}\n", options.warning);
}

// A program that waits for a change watches the directory, because a rename puts the new file there.
void tell_state(const fs::path& beside, const std::string& state) {
  static const std::uint64_t started = launch::read_process_stat(getpid()).started;
  launch::replace_file(beside / "kernel-recorder.pid", fmt::format("{} {} {}\n", getpid(), started, state));
}

void tell_end(const fs::path& beside, std::uint64_t events, std::uint64_t lost_events, std::uint64_t bytes) {
  launch::replace_file(
      beside / "kernel-recorder.json",
      fmt::format("{{\"events\": {}, \"lost_events\": {}, \"bytes\": {}}}\n", events, lost_events, bytes));
  fs::remove(beside / "kernel-recorder.pid");
}

int next_signal(int signals) {
  signalfd_siginfo signal{};
  return read(signals, &signal, sizeof signal) == sizeof signal ? static_cast<int>(signal.ssi_signo) : SIGTERM;
}

void record(TracefsInstance& instance, const fs::path& directory, const Options& options, int signals) {
  fs::create_directories(directory);
  const fs::path beside = directory.parent_path();
  ThreadTable threads(instance.watch_event("task/task_newtask"), instance.watch_event("task/task_rename"));
  CtfWriter writer(directory, random_uuid(), instance.formats(), options.context_fields, threads);
  const std::vector<RingBuffer> buffers = open_buffers(instance);
  std::vector<pollfd> watched = {{signals, POLLIN, 0}};
  for (const RingBuffer& buffer : buffers) {
    watched.push_back({buffer.file.get(), POLLIN, 0});
  }
  instance.start();
  tell_state(beside, "recording");
  say(ready(options));

  const auto stop_and_write = [&] {
    instance.stop();
    drain(buffers, writer, threads);
    writer.write_metadata(clock_beside(beside / "ust"));
  };
  for (bool ended = false; !ended;) {
    if (poll(watched.data(), watched.size(), -1) < 0) {
      if (errno == EINTR) {
        continue;
      }
      break;
    }
    if ((watched[0].revents & POLLIN) == 0) {
      drain(buffers, writer, threads);
      continue;
    }
    switch (next_signal(signals)) {
      case SIGUSR1:
        stop_and_write();
        tell_state(beside, "paused");
        break;
      case SIGUSR2:
        instance.start();
        tell_state(beside, "recording");
        break;
      default:
        ended = true;
    }
  }
  stop_and_write();
  tell_end(beside, writer.events(), writer.lost_events(), writer.bytes());
}

struct Request {
  fs::path snapshot;
  bool clear = false;
};

Request requested(const fs::path& beside) {
  std::ifstream file(beside / "kernel-recorder.request");
  std::string directory, what;
  std::getline(file, directory);
  std::getline(file, what);
  return {directory, what == "clear"};
}

void keep_for_snapshots(TracefsInstance& instance, const fs::path& beside, const Options& options, int signals) {
  fs::create_directories(beside);
  instance.keep_newest();
  const ThreadTable no_threads(instance.watch_event("task/task_newtask"), instance.watch_event("task/task_rename"));
  SnapshotWriter writer(TracefsInstance::kBufferBytes, instance.formats(), options.context_fields, no_threads);
  const std::vector<RingBuffer> buffers = open_buffers(instance);
  instance.start();
  tell_state(beside, "recording");
  say(ready(options));

  for (bool ended = false; !ended;) {
    const int signal = next_signal(signals);
    if (signal == SIGRTMIN) {
      const auto [snapshot, clear] = requested(beside);
      try {
        read_buffers(buffers, [&](unsigned cpu, PageHistory::Page page) { writer.add(cpu, std::move(page)); });
        fs::create_directories(snapshot / "kernel");
        writer.write(snapshot / "kernel", clock_beside(snapshot / "ust"));
        if (clear) {
          writer.clear();
        }
        tell_state(beside, snapshot.filename());
      } catch (const std::exception& error) {
        tell_state(beside, fmt::format("failed {}: {}", snapshot.filename().string(), error.what()));
      }
    } else if (signal == SIGUSR1) {
      instance.stop();
      tell_state(beside, "paused");
    } else if (signal == SIGUSR2) {
      instance.start();
      tell_state(beside, "recording");
    } else {
      ended = true;
    }
  }
  fs::remove(beside / "kernel-recorder.request");
  tell_end(beside, 0, 0, 0);  // a snapshot has lost what is older, by design
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    return 2;
  }
  const int signals = control_signals();
  try {
    TracefsInstance instance(argv[1]);
    const Options options = enable(instance, argc, argv);
    const fs::path directory = argv[2];
    if (options.snapshots) {
      keep_for_snapshots(instance, directory.parent_path(), options, signals);
    } else {
      record(instance, directory, options, signals);
    }
    return 0;
  } catch (const KernelTraceError& error) {
    say(fmt::format("error: {}\n{}", error.what(),
                    error.remedy().empty() ? std::string() : fmt::format("hint: {}\n", error.remedy())));
  } catch (const std::exception& error) {
    say(fmt::format("error: {}\n", error.what()));
  }
  return 1;
}
