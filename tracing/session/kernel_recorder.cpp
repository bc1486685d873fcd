#include "tracing/session/kernel_recorder.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

namespace tracing {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFolder = "kernel";
constexpr const char* kChannel = "kernel";
constexpr int kLongestEnd = 30'000;  // ms

std::vector<std::string> arguments_of(const fs::path& program, const std::string& session, const fs::path& recording,
                                      const std::vector<ChannelPlan>& plans) {
  std::vector<std::string> arguments = {program.string(), "launch-" + session, (recording / kFolder).string()};
  for (const ChannelPlan& plan : plans) {
    if (plan.domain != LTTNG_DOMAIN_KERNEL) continue;
    for (const EventRule& rule : plan.events) arguments.insert(arguments.end(), {"event", rule.pattern, rule.filter});
    for (const std::string& name : plan.syscalls) arguments.insert(arguments.end(), {"syscall", name});
  }
  return arguments;
}

// What the program says until it closes its output. It goes on then, in a session of its own: a Ctrl-C is not for it.
std::string start_and_listen(const std::vector<std::string>& arguments) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw TraceError("cannot start the kernel recorder: no pipe");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addclosefrom_np(&actions, STDERR_FILENO + 1);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID);
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  pid_t pid = -1;
  const int error = posix_spawn(&pid, argv[0], &actions, &attributes, argv.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  std::string said;
  std::array<char, 1024> buffer{};
  if (error == 0) {
    for (ssize_t length; (length = read(ends[0], buffer.data(), buffer.size())) > 0;) {
      said.append(buffer.data(), static_cast<std::size_t>(length));
    }
  }
  close(ends[0]);
  if (error != 0) throw TraceError(fmt::format("cannot start {}: {}", arguments[0], std::strerror(error)));
  if (!said.starts_with("ready")) waitpid(pid, nullptr, 0);
  return said;
}

// The rest of the line that begins with `key`.
std::string line_after(const std::string& text, const std::string& key) {
  const std::size_t found = text.find(key);
  if (found == std::string::npos) return {};
  const std::size_t begin = found + key.size();
  return text.substr(begin, text.find('\n', begin) - begin);
}

}  // namespace

void start_kernel_recorder(const fs::path& program, const std::string& session, const fs::path& recording,
                           const std::vector<ChannelPlan>& plans) {
  const std::string said = start_and_listen(arguments_of(program, session, recording, plans));
  if (said.starts_with("ready")) return;
  const std::string reason = line_after(said, "error: ");
  throw TraceError(
      fmt::format("kernel events cannot be recorded: {}", reason.empty() ? "their recorder ended at once" : reason),
      line_after(said, "hint: "));
}

std::optional<ChannelLoss> finish_kernel_recorder(const fs::path& recording) {
  pid_t pid = 0;
  if (!(std::ifstream(recording / "kernel-recorder.pid") >> pid) || pid <= 0) return std::nullopt;
  const int pidfd = static_cast<int>(syscall(SYS_pidfd_open, pid, 0));
  if (pidfd >= 0) {
    kill(pid, SIGTERM);
    pollfd end{pidfd, POLLIN, 0};
    while (poll(&end, 1, kLongestEnd) < 0 && errno == EINTR) {
    }
    close(pidfd);
    waitpid(pid, nullptr, WNOHANG);  // when it is our child
  }
  ChannelLoss loss{.domain = "kernel", .channel = kChannel};
  const fs::path result = recording / "kernel-recorder.json";
  std::ifstream file(result);
  const auto said = nlohmann::json::parse(file, nullptr, false);
  std::error_code ignored;
  fs::remove(result, ignored);
  if (said.is_discarded()) {
    throw TraceError("the kernel recorder has not ended as it should: kernel events of this trace are lost");
  }
  loss.discarded_events = said.value("lost_events", std::uint64_t{0});
  return loss;
}

}  // namespace tracing
