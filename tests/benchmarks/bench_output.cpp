// SPDX-License-Identifier: Apache-2.0
// Measures how fast the lines of a child get to the screen (/dev/null) and to launch.log. The floor reads the same
// child through a bare pipe and writes its bytes to two files as they are. Both take turns in the same run; prints
// medians.
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "launcher/process/process_supervisor.hpp"
#include "tests/benchmarks/samples/samples_file.hpp"

namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr int kLines = 1'000'000;
constexpr int kRounds = 5;

launch::ProcessSpec chatter() {
  launch::ProcessSpec spec;
  spec.name = "chatter";
  spec.argv = {
      "/bin/sh", "-c",
      fmt::format("yes '[INFO] [1700000000.123456789] [talker]: Publishing: Hello World' | head -n {}", kLines)};
  spec.environment = {{"PATH", "/usr/bin:/bin"}};
  spec.output = *launch::OutputRouting::from_mode("both");
  return spec;
}

double run_bare(launch::ProcessRunner& runner, const std::string& directory) {
  const launch::UniqueFd null(::open("/dev/null", O_WRONLY | O_CLOEXEC));
  const launch::UniqueFd log(::open((directory + "/bare.log").c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600));
  std::vector<char> buffer(64 * 1024);
  const auto start = Clock::now();
  const launch::Process process = runner.spawn(chatter());
  pollfd readable{process.out.get(), POLLIN, 0};
  while (true) {
    ::poll(&readable, 1, -1);
    const ssize_t size = ::read(process.out.get(), buffer.data(), buffer.size());
    if (size <= 0) {
      break;
    }
    for (const int fd : {null.get(), log.get()}) {
      if (::write(fd, buffer.data(), static_cast<std::size_t>(size)) != size) {
        throw std::runtime_error("cannot write");
      }
    }
  }
  const double time = Seconds(Clock::now() - start).count();
  pollfd exited{process.pidfd.get(), POLLIN, 0};
  ::poll(&exited, 1, -1);
  runner.reap(process);
  return time;
}

double run_supervised(launch::ProcessRunner& runner, const std::string& directory) {
  const launch::UniqueFd null(::open("/dev/null", O_WRONLY | O_CLOEXEC));
  std::filesystem::remove(directory + "/launch.log");
  const auto loop = launch::make_sd_event_loop();
  launch::OutputRouter::Options options;
  options.screen_fd = null.get();
  options.log_directory = directory;
  launch::OutputRouter output(options);
  launch::ProcessSupervisor supervisor(*loop, runner, output);
  supervisor.observe([&](const launch::ProcessEvent& event) {
    if (std::holds_alternative<launch::ProcessDone>(event.what)) {
      loop->quit();
    }
  });
  const auto start = Clock::now();
  supervisor.start(chatter());
  loop->run();
  return Seconds(Clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace

int main() {
  std::string directory = (std::filesystem::temp_directory_path() / "bench-output-XXXXXX").string();
  if (::mkdtemp(directory.data()) == nullptr) {
    fmt::print(stderr, "bench_output: cannot create '{}'\n", directory);
    return EXIT_FAILURE;
  }
  int result = EXIT_SUCCESS;
  try {
    const auto runner = launch::make_posix_process_runner();
    std::vector<double> bare;
    std::vector<double> supervised;
    for (int round = 0; round < kRounds; ++round) {
      bare.push_back(run_bare(*runner, directory));
      supervised.push_back(run_supervised(*runner, directory));
    }
    benchmarks::report(
        {fmt::format("{} lines of a child", kLines), "s", supervised, "read and written by a loop", bare});
    fmt::print("million lines of a child per second, to /dev/null and a file\n");
    fmt::print("{:>9} {:>11} {:>7}\n", "bare", "supervised", "ratio");
    fmt::print("{:>9.2f} {:>11.2f} {:>7.2f}\n", kLines / median(bare) / 1e6, kLines / median(supervised) / 1e6,
               median(supervised) / median(bare));
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_output: {}\n", error.what());
    result = EXIT_FAILURE;
  }
  std::filesystem::remove_all(directory);
  return result;
}
