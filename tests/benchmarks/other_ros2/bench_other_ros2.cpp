// SPDX-License-Identifier: Apache-2.0
// What it costs a node of another ROS 2 to be recorded: with the tracetools of this stack that stands in for its own,
// and with its own. The nodes are programs of tests/support/other_ros2/, which call tracetools as rmw and rclcpp of
// each distribution do, here for two events, once a millisecond: rmw_publish and callback_end.
//
// bench_other_ros2 [RUNS]: the median of so many runs (5), each of the median of 2,000 milliseconds, in turns.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using namespace test_support;

enum class Traced { kNot, kOwn, kTheirs };

double run(const std::string& distribution, Traced traced) {
  const Sandbox sandbox;
  const std::string prefix = std::string(OTHER_ROS2) + "/" + distribution;
  const std::string trace = traced == Traced::kNot ? ""
                                                   : fmt::format(R"(<trace session-name="run" tracetools="{}"/>)",
                                                                 traced == Traced::kOwn ? "own" : "theirs");
  const std::filesystem::path file = sandbox.directory() / "run.launch.xml";
  write_file(file, fmt::format(R"(<launch>{}<executable output="screen" cmd="{}/lib/demo/talker 2000 1000 recorded">
  <env name="LD_LIBRARY_PATH" value="{}/lib"/></executable></launch>)",
                               trace, prefix, prefix));
  const CommandResult result = run_command({LAUNCH_PROGRAM, file.string()});
  const std::size_t at = result.out.find("median ");
  if (result.exit_code != 0 || at == std::string::npos) {
    fmt::print(stderr, "{}{}", result.out, result.err);
    std::exit(1);
  }
  return std::stod(result.out.substr(at + 7));
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::atoi(argv[1]) : 5;
  for (const char* const distribution : {"humble", "iron", "jazzy", "kilted", "newest"}) {
    std::vector<double> none;
    std::vector<double> own;
    std::vector<double> theirs;
    for (int i = 0; i < runs; ++i) {
      none.push_back(run(distribution, Traced::kNot));
      own.push_back(run(distribution, Traced::kOwn));
      theirs.push_back(run(distribution, Traced::kTheirs));
    }
    const double ours = median(own) - median(none);
    const double its = median(theirs) - median(none);
    fmt::print("{}: two events cost {:.0f} ns with our tracetools, {:.0f} ns with its own: {:.3f}\n", distribution,
               ours, its, ours / its);
  }
}
