// SPDX-License-Identifier: Apache-2.0
// How reliable `launch report --diff` is with real runs: how often it finds a change between two runs of one system,
// and how often it finds exactly the one of fifty callbacks that takes 2 ms longer in the second run. Usage:
//   bench_comparison [PAIRS [SECONDS]]
#include <fmt/format.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string>

#include "tests/support/trace_writer/temporary_directory.hpp"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kCallbacks = 50;

void run(const std::string& command) {
  const int status = std::system(command.c_str());
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw std::runtime_error("failed: " + command);
  }
}

class Comparisons {
 public:
  explicit Comparisons(int seconds) : seconds_(seconds) {}

  // Returns the directory of the trace.
  fs::path record(const std::string& name, int slow) const {
    const fs::path log = directory_.path() / "output";
    run(fmt::format("cd {} && ROS_HOME={} {} {} program:={} directory:={} seconds:={} slow:={} >{} 2>&1",
                    directory_.path().native(), directory_.path().native(), LAUNCH_PROGRAM, LAUNCH_FILE,
                    FIFTY_CALLBACKS, name, seconds_, slow, log.native()));
    return directory_.path() / name;
  }

  json compare(const fs::path& before, const fs::path& after) const {
    const fs::path result = directory_.path() / "result.json";
    run(fmt::format("{} --diff {} {} --json >{}", LAUNCH_REPORT, before.native(), after.native(), result.native()));
    std::ifstream file(result);
    return json::parse(file);
  }

 private:
  tracing::testing::TemporaryDirectory directory_;
  int seconds_;
};

std::string name_of(int callback) {
  return callback % 2 == 0 ? fmt::format("/source_{}, timer 20 ms", callback / 2)
                           : fmt::format("/sink_{0}, subscription /topic_{0}", callback / 2);
}

std::set<std::string> changed_callbacks(const json& comparison) {
  std::set<std::string> names;
  for (const json& change : comparison["changes"]) {
    if (change["kind"] == "callback") {
      names.insert(change["subject"]);
    }
  }
  return names;
}

void count(int pairs, int seconds) {
  const Comparisons comparisons(seconds);
  int alarms = 0;
  int found = 0;
  fs::path before = comparisons.record("run_0", -1);
  for (int pair = 0; pair < pairs; ++pair) {
    const fs::path same = comparisons.record(fmt::format("run_{}", pair + 1), -1);
    const int slow = pair * 7 % kCallbacks;
    const fs::path changed = comparisons.record(fmt::format("slow_{}", pair), slow);
    if (!comparisons.compare(before, same)["changes"].empty()) {
      ++alarms;
    }
    if (changed_callbacks(comparisons.compare(before, changed)) == std::set{name_of(slow)}) {
      ++found;
    }
    fmt::print("pair {}: {} of {} with a change where there is none, exactly the slow callback found in {}\n", pair + 1,
               alarms, pair + 1, found);
    std::fflush(stdout);
    fs::remove_all(before);
    fs::remove_all(changed);
    before = same;
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    count(argc > 1 ? std::atoi(argv[1]) : 20, argc > 2 ? std::atoi(argv[2]) : 5);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_comparison: error: {}\n", error.what());
    return 1;
  }
}
