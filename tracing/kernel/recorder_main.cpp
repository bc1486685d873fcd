// launch-kernel-recorder INSTANCE DIRECTORY [event NAME FILTER | syscall NAME]…
//
// Records events of the kernel into DIRECTORY until it gets SIGTERM, without modules of LTTng. Says "ready" once it
// records, or "error: …" and "hint: …", and closes its output. While it runs DIRECTORY/../kernel-recorder.pid holds its
// number; at the end kernel-recorder.json there says what it has recorded and lost. (Readers of CTF take every file of
// DIRECTORY for a stream.)
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <system_error>
#include <utility>
#include <vector>

#include "tracing/kernel/ctf_writer.hpp"
#include "tracing/kernel/tracefs.hpp"

namespace {

namespace fs = std::filesystem;
using namespace tracing::kernel;

constexpr std::size_t kLargestPage = 65536;  // sub-buffers can be made larger than a page since Linux 6.8

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) close(fd_);
  }
  int get() const { return fd_; }

 private:
  int fd_;
};

struct RingBuffer {
  unsigned cpu;
  Descriptor file;
};

// Blocked from the beginning, read from a descriptor.
int termination_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) sigaddset(&signals, signal);
  sigprocmask(SIG_BLOCK, &signals, nullptr);
  return signalfd(-1, &signals, SFD_CLOEXEC);
}

std::vector<RingBuffer> open_buffers(const TracefsInstance& instance) {
  std::vector<RingBuffer> buffers;
  for (const auto& [cpu, path] : instance.ring_buffers()) {
    Descriptor file(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    if (file.get() < 0) throw KernelTraceError(fmt::format("cannot read {}: {}", path.string(), std::strerror(errno)));
    buffers.push_back({cpu, std::move(file)});
  }
  return buffers;
}

void drain(const RingBuffer& buffer, CtfWriter& writer) {
  static std::array<std::uint8_t, kLargestPage> page;
  for (ssize_t length; (length = read(buffer.file.get(), page.data(), page.size())) > 0;) {
    writer.write_page(buffer.cpu, {page.data(), static_cast<std::size_t>(length)});
  }
}

void enable(TracefsInstance& instance, int argc, char** argv) {
  for (int i = 3; i < argc;) {
    const std::string kind = argv[i];
    if (kind == "event" && i + 2 < argc) {
      instance.enable_event(argv[i + 1], argv[i + 2]);
      i += 3;
    } else if (kind == "syscall" && i + 1 < argc) {
      instance.enable_syscall(argv[i + 1]);
      i += 2;
    } else {
      throw KernelTraceError("launch-kernel-recorder: bad arguments");
    }
  }
}

void say(const std::string& text) {
  fmt::print("{}", text);
  std::fflush(stdout);
  // Whoever reads us is waiting for the end.
  const Descriptor null(open("/dev/null", O_WRONLY | O_CLOEXEC));
  dup2(null.get(), STDOUT_FILENO);
}

void record(TracefsInstance& instance, const fs::path& directory, int signals) {
  fs::create_directories(directory);
  const fs::path beside = directory.parent_path();
  CtfWriter writer(directory, instance.formats());
  const std::vector<RingBuffer> buffers = open_buffers(instance);
  std::vector<pollfd> watched = {{signals, POLLIN, 0}};
  for (const RingBuffer& buffer : buffers) watched.push_back({buffer.file.get(), POLLIN, 0});
  std::ofstream(beside / "kernel-recorder.pid") << getpid() << "\n";
  instance.start();
  say("ready\n");

  while ((watched[0].revents & POLLIN) == 0) {
    if (poll(watched.data(), watched.size(), -1) < 0 && errno != EINTR) break;
    for (std::size_t i = 0; i < buffers.size(); ++i) {
      if (watched[i + 1].revents != 0) drain(buffers[i], writer);
    }
  }
  instance.stop();
  for (const RingBuffer& buffer : buffers) drain(buffer, writer);
  writer.write_metadata(clock_beside(beside / "ust"));
  std::ofstream(beside / "kernel-recorder.json")
      << fmt::format("{{\"events\": {}, \"lost_events\": {}, \"bytes\": {}}}\n", writer.events(), writer.lost_events(),
                     writer.bytes());
  fs::remove(beside / "kernel-recorder.pid");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  const int signals = termination_signals();
  try {
    TracefsInstance instance(argv[1]);
    enable(instance, argc, argv);
    record(instance, argv[2], signals);
    return 0;
  } catch (const KernelTraceError& error) {
    say(fmt::format("error: {}\n{}", error.what(),
                    error.remedy().empty() ? std::string() : fmt::format("hint: {}\n", error.remedy())));
  } catch (const std::exception& error) {
    say(fmt::format("error: {}\n", error.what()));
  }
  return 1;
}
