// SPDX-License-Identifier: Apache-2.0
// Usage: bench_trace_session [RUNS]
//
// Measures the time that a <trace> adds to a launch of two nodes that takes a second, by `launch --timing`: to its
// start with a running session daemon and without one, and to its end, after the last exit. RUNS (default: 11) launches
// for each.
#include <fmt/format.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/mount.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "tests/benchmarks/samples/samples_file.hpp"

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& what) {
  fmt::print(stderr, "bench_trace_session: {}\n", what);
  std::exit(1);
}

// Makes a session daemon of our own: root has one in /run, other users have one in LTTNG_HOME.
void isolate(const fs::path& directory) {
  setenv("LTTNG_HOME", directory.c_str(), 1);
  setenv("XDG_CACHE_HOME", directory.c_str(), 1);
  setenv("ROS_HOME", directory.c_str(), 1);
  setenv("ROS_LOG_DIR", (directory / "log").c_str(), 1);
  if (geteuid() == 0 && (unshare(CLONE_NEWNS) != 0 || mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
                         mount("tmpfs", "/run", "tmpfs", 0, "mode=1777") != 0)) {
    fail("no mount namespace of its own");
  }
}

void end_session_daemon(const fs::path& directory) {
  const fs::path file = (geteuid() == 0 ? fs::path("/run/lttng") : directory / ".lttng") / "lttng-sessiond.pid";
  pid_t pid = 0;
  if (!(std::ifstream(file) >> pid)) {
    return;
  }
  pollfd death{static_cast<int>(syscall(SYS_pidfd_open, pid, 0)), POLLIN, 0};
  kill(pid, SIGTERM);
  poll(&death, 1, 10'000);
  close(death.fd);
}

// The steps that `launch --timing` prints, in milliseconds.
std::map<std::string, double> launch(const fs::path& file) {
  const std::string command = fmt::format("{} --timing {} 2>&1", LAUNCH_PROGRAM, file.string());
  FILE* const output = popen(command.c_str(), "r");
  std::map<std::string, double> steps;
  std::string text;
  for (char line[512]; std::fgets(line, sizeof line, output) != nullptr;) {
    text += line;
    char name[64];
    double milliseconds = 0;
    if (std::sscanf(line, "  %36[^\n] %lf ms", name, &milliseconds) == 2) {
      std::string step(name);
      step.erase(step.find_last_not_of(' ') + 1);
      steps[step] = milliseconds;
    }
  }
  if (pclose(output) != 0 || steps.empty() || text.find("trace is complete") == std::string::npos) {
    fail("a launch failed:\n" + text);
  }
  return steps;
}

double sum_of(const std::map<std::string, double>& steps, const std::string& prefix) {
  double sum = 0;
  for (const auto& [name, milliseconds] : steps) {
    sum += name.rfind(prefix, 0) == 0 ? milliseconds : 0;
  }
  return sum;
}

void print(const char* what, std::vector<double> milliseconds, double aim) {
  benchmarks::report({what, "ms", milliseconds});
  std::sort(milliseconds.begin(), milliseconds.end());
  const double median = milliseconds[milliseconds.size() / 2];
  fmt::print("  {:<46} {:7.1f} {:7.1f}   {:>5} {}\n", what, milliseconds.front(), median,
             aim == 0 ? "" : fmt::format("< {:.0f}", aim),
             aim == 0       ? ""
             : median < aim ? "reached"
                            : "missed");
}

}  // namespace

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::max(1, std::atoi(argv[1])) : 11;
  std::string directory = (fs::temp_directory_path() / "bench_trace_session-XXXXXX").string();
  if (mkdtemp(directory.data()) == nullptr) {
    fail("cannot create " + directory);
  }
  isolate(directory);
  const fs::path file = fs::path(directory) / "two_nodes.launch.xml";
  std::ofstream(file) << "<launch>\n  <trace session-name=\"bench\" append-timestamp=\"true\" append-trace=\"true\" "
                      << "base-path=\"" << directory << "/traces\"/>\n"
                      << "  <executable cmd=\"" TRACED_NODE_PROGRAM " 1000 1\"/>\n"
                      << "  <executable cmd=\"" TRACED_NODE_PROGRAM " 1000 1\"/>\n</launch>\n";
  std::vector<double> cold, warm, ended, left;
  launch(file);  // measures the cost of an event, once on a machine
  for (int run = 0; run < runs; ++run) {
    end_session_daemon(directory);
    cold.push_back(sum_of(launch(file), "trace: "));
    const auto steps = launch(file);
    warm.push_back(sum_of(steps, "trace: "));
    ended.push_back(sum_of(steps, "trace end: ") - sum_of(steps, "trace end: summary"));
    left.push_back(sum_of(steps, "end, from the last exit"));
  }
  fmt::print("what a <trace> adds to a launch, ms of {} runs          least  median    aim\n", runs);
  print("start, session daemon and consumer running", warm, 5);
  print("start, neither running", cold, 180);
  print("last exit to the end of the session", ended, 50);
  print("last exit to the end, its summary included", left, 0);
  end_session_daemon(directory);
  fs::remove_all(directory);
}
