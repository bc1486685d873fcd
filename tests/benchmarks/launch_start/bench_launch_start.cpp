// SPDX-License-Identifier: Apache-2.0
// Measures the time from the start of `launch FILE` until both of its processes run, and the memory that the launcher
// then holds. The floor is a bare loop that starts the same two programs.
#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

extern char** environ;  // NOLINT: POSIX names it so

namespace {

namespace fs = std::filesystem;

constexpr int kRuns = 21;
constexpr int kProcesses = 2;

std::int64_t now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec * 1'000'000'000 + time.tv_nsec;
}

pid_t start(const std::vector<std::string>& command) {
  std::vector<char*> argv;
  for (const std::string& word : command) {
    argv.push_back(const_cast<char*>(word.c_str()));
  }
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t pid = -1;
  if (posix_spawn(&pid, argv[0], &actions, nullptr, argv.data(), environ) != 0) {
    std::perror(argv[0]);
    std::exit(1);
  }
  posix_spawn_file_actions_destroy(&actions);
  return pid;
}

// The latest of the times that the started programs write.
std::int64_t last_stamp(int pipe) {
  std::int64_t last = 0;
  for (int i = 0; i < kProcesses; ++i) {
    std::int64_t stamp = 0;
    if (read(pipe, &stamp, sizeof stamp) != sizeof stamp) {
      std::perror("read");
      std::exit(1);
    }
    last = std::max(last, stamp);
  }
  return last;
}

void end(pid_t pid) {
  kill(pid, SIGINT);
  waitpid(pid, nullptr, 0);
}

// The value in kilobytes of the line of this name in /proc/PID/status.
long memory_of(pid_t pid, const std::string& line_name) {
  std::ifstream status(fmt::format("/proc/{}/status", pid));
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(line_name)) {
      return std::stol(line.substr(line_name.size()));
    }
  }
  return 0;
}

// The started process is the guardian, and the launcher its first child.
pid_t launcher_below(pid_t guardian) {
  std::ifstream children(fmt::format("/proc/{0}/task/{0}/children", guardian));
  pid_t launcher = guardian;
  children >> launcher;
  return launcher;
}

double milliseconds(std::int64_t nanoseconds) {
  return static_cast<double>(nanoseconds) / 1e6;
}

std::int64_t median(std::vector<std::int64_t> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace

int main() {
  char pattern[] = "/tmp/bench-launch-start-XXXXXX";
  const fs::path directory = mkdtemp(pattern);
  const std::string pipe_path = directory / "stamps";
  mkfifo(pipe_path.c_str(), 0600);
  const int pipe = open(pipe_path.c_str(), O_RDWR | O_CLOEXEC);
  setenv("STAMP_PIPE", pipe_path.c_str(), 1);
  setenv("ROS_LOG_DIR", (directory / "log").c_str(), 1);
  const std::string file = directory / "system.launch.xml";
  std::ofstream(file) << "<launch>\n<executable cmd=\"" STAMP_PROGRAM "\"/>\n<executable cmd=\"" STAMP_PROGRAM
                         "\"/>\n</launch>\n";

  std::vector<std::int64_t> launched;
  std::vector<std::int64_t> bare;
  std::vector<std::int64_t> resident;
  std::vector<std::int64_t> private_memory;
  std::vector<std::int64_t> guardian_memory;
  for (int run = 0; run < kRuns; ++run) {
    std::int64_t begin = now();
    const pid_t guardian = start({LAUNCH_PROGRAM, file});
    launched.push_back(last_stamp(pipe) - begin);
    const pid_t launcher = launcher_below(guardian);
    guardian_memory.push_back(memory_of(guardian, "VmRSS:"));
    resident.push_back(memory_of(launcher, "VmRSS:"));
    private_memory.push_back(memory_of(launcher, "RssAnon:"));
    end(guardian);

    begin = now();
    const pid_t first = start({STAMP_PROGRAM});
    const pid_t second = start({STAMP_PROGRAM});
    bare.push_back(last_stamp(pipe) - begin);
    end(first);
    end(second);
  }
  fmt::print("from the command to two running processes, median of {} runs\n", kRuns);
  fmt::print("  launch               {:8.2f} ms\n", milliseconds(median(launched)));
  fmt::print("  bare posix_spawn     {:8.2f} ms   ratio {:.1f}\n", milliseconds(median(bare)),
             milliseconds(median(launched)) / milliseconds(median(bare)));
  fmt::print("  launcher resident    {:8.1f} MiB, of it private {:.1f} MiB\n",
             static_cast<double>(median(resident)) / 1024, static_cast<double>(median(private_memory)) / 1024);
  fmt::print("  guardian resident    {:8.1f} MiB\n", static_cast<double>(median(guardian_memory)) / 1024);
  fs::remove_all(directory);
}
