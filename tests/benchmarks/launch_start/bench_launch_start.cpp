// SPDX-License-Identifier: Apache-2.0
// Usage: bench_launch_start [RUNS [PROCESSES...]]
//
// Measures the time from the start of `launch FILE` until all of its processes run, the memory that the launcher then
// holds, how long `launch ps` takes, and the time from SIGINT until everything has ended. The floor is a bare loop that
// starts and ends the same programs; that of `launch ps` is ps(1) of the same processes. Default: 21 runs of two
// processes.
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
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/benchmarks/samples/samples_file.hpp"

extern char** environ;  // NOLINT: POSIX names it so

namespace {

namespace fs = std::filesystem;

constexpr int kDefaultRuns = 21;
constexpr int kDefaultProcesses = 2;

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
std::int64_t last_stamp(int pipe, int count) {
  std::int64_t last = 0;
  for (int i = 0; i < count; ++i) {
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

// The value of the line of this name in /proc/PID/status.
double mebibytes_of(pid_t pid, const std::string& line_name) {
  std::ifstream status(fmt::format("/proc/{}/status", pid));
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(line_name)) {
      return static_cast<double>(std::stol(line.substr(line_name.size()))) / 1024;
    }
  }
  return 0;
}

// The started process is the guardian, the spare guardian its first child, and the launcher the first child of that.
pid_t launcher_below(pid_t guardian) {
  pid_t process = guardian;
  for (int level = 0; level < 2; ++level) {
    std::ifstream children(fmt::format("/proc/{0}/task/{0}/children", process));
    children >> process;
  }
  return process;
}

using Values = std::vector<double>;

double median(Values values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

double milliseconds_since(std::int64_t begin) {
  return static_cast<double>(now() - begin) / 1e6;
}

void write_launch_file(const std::string& path, int count) {
  std::ofstream file(path);
  file << "<launch>\n";
  for (int i = 0; i < count; ++i) {
    file << "<executable cmd=\"" STAMP_PROGRAM "\"/>\n";
  }
  file << "</launch>\n";
}

// One value for each run: milliseconds, and mebibytes of memory.
struct Measured {
  Values launched, stopped;
  Values listed, bare_list;
  Values bare_start, bare_stop;
  Values resident, private_memory, guardian_memory;
};

// In milliseconds.
double time_of(const std::vector<std::string>& command) {
  const std::int64_t begin = now();
  waitpid(start(command), nullptr, 0);
  return milliseconds_since(begin);
}

void measure_launch(Measured& measured, const std::string& file, int count, int pipe) {
  const std::int64_t begin = now();
  const pid_t guardian = start({LAUNCH_PROGRAM, file});
  measured.launched.push_back(static_cast<double>(last_stamp(pipe, count) - begin) / 1e6);
  const pid_t launcher = launcher_below(guardian);
  measured.guardian_memory.push_back(mebibytes_of(guardian, "VmRSS:"));
  measured.resident.push_back(mebibytes_of(launcher, "VmRSS:"));
  measured.private_memory.push_back(mebibytes_of(launcher, "RssAnon:"));
  measured.listed.push_back(time_of({LAUNCH_PROGRAM, "ps"}));
  measured.bare_list.push_back(
      time_of({"/bin/ps", "-o", "pid,pcpu,rss,etime,args", "--ppid", std::to_string(launcher)}));
  const std::int64_t stop = now();
  end(guardian);
  measured.stopped.push_back(milliseconds_since(stop));
}

void measure_bare(Measured& measured, int count, int pipe) {
  const std::int64_t begin = now();
  std::vector<pid_t> pids;
  for (int i = 0; i < count; ++i) {
    pids.push_back(start({STAMP_PROGRAM}));
  }
  measured.bare_start.push_back(static_cast<double>(last_stamp(pipe, count) - begin) / 1e6);
  const std::int64_t stop = now();
  for (const pid_t pid : pids) {
    kill(pid, SIGINT);
  }
  for (const pid_t pid : pids) {
    waitpid(pid, nullptr, 0);
  }
  measured.bare_stop.push_back(milliseconds_since(stop));
}

void print(const Measured& measured, int count, int runs) {
  const double launched = median(measured.launched);
  const double stopped = median(measured.stopped);
  fmt::print("from the command to {} running processes, median of {} runs\n", count, runs);
  fmt::print("  launch               {:8.2f} ms\n", launched);
  fmt::print("  bare posix_spawn     {:8.2f} ms   ratio {:.1f}\n", median(measured.bare_start),
             launched / median(measured.bare_start));
  fmt::print("from SIGINT to the end\n");
  fmt::print("  launch               {:8.2f} ms\n", stopped);
  fmt::print("  bare kill, waitpid   {:8.2f} ms   ratio {:.1f}\n", median(measured.bare_stop),
             stopped / median(measured.bare_stop));
  fmt::print("a list of what runs\n");
  fmt::print("  launch ps            {:8.2f} ms\n", median(measured.listed));
  fmt::print("  ps(1)                {:8.2f} ms   ratio {:.1f}\n", median(measured.bare_list),
             median(measured.listed) / median(measured.bare_list));
  fmt::print("  launcher resident    {:8.1f} MiB, of it private {:.1f} MiB\n", median(measured.resident),
             median(measured.private_memory));
  fmt::print("  guardian resident    {:8.1f} MiB\n", median(measured.guardian_memory));
  std::fflush(stdout);
  const std::string processes = fmt::format("{} process{}", count, count == 1 ? "" : "es");
  benchmarks::report({processes + " started", "ms", measured.launched, "a posix_spawn loop", measured.bare_start});
  benchmarks::report({processes + " stopped", "ms", measured.stopped, "kill and waitpid", measured.bare_stop});
  benchmarks::report({processes + " listed by launch ps", "ms", measured.listed, "ps", measured.bare_list});
  benchmarks::report({processes + ", memory of the launcher", "MiB", measured.resident});
}

}  // namespace

int main(int argc, char** argv) {
  // A shell has its background commands ignore SIGINT, which ends the processes here.
  signal(SIGINT, SIG_DFL);
  const int runs = argc > 1 ? std::max(1, std::atoi(argv[1])) : kDefaultRuns;
  std::vector<int> counts;
  for (int i = 2; i < argc; ++i) {
    counts.push_back(std::max(1, std::atoi(argv[i])));
  }
  if (counts.empty()) {
    counts.push_back(kDefaultProcesses);
  }
  char pattern[] = "/tmp/bench-launch-start-XXXXXX";
  const fs::path directory = mkdtemp(pattern);
  const std::string pipe_path = directory / "stamps";
  mkfifo(pipe_path.c_str(), 0600);
  const int pipe = open(pipe_path.c_str(), O_RDWR | O_CLOEXEC);
  setenv("STAMP_PIPE", pipe_path.c_str(), 1);
  setenv("ROS_LOG_DIR", (directory / "log").c_str(), 1);
  setenv("XDG_RUNTIME_DIR", directory.c_str(), 1);  // `launch ps` finds no other launch there
  for (const int count : counts) {
    const std::string file = directory / fmt::format("{}.launch.xml", count);
    write_launch_file(file, count);
    Measured measured;
    for (int run = 0; run < runs; ++run) {
      measure_launch(measured, file, count, pipe);
      measure_bare(measured, count, pipe);
    }
    print(measured, count, runs);
  }
  fs::remove_all(directory);
}
