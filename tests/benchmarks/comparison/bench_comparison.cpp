// SPDX-License-Identifier: Apache-2.0
// How reliable `launch report --diff` is with real runs of twenty callbacks, half of them beside other busy programs:
// how often it finds a change between two runs of one system, and how often it names exactly the callback that takes
// 2 ms or 20 % longer in the second run. Usage:
//   bench_comparison [TRIALS [SECONDS [DIRECTORY [RUNS]]]]
// Each trial has four times RUNS runs of SECONDS, by default one: RUNS on each side. DIRECTORY keeps them as baselines,
// and those that it has are not recorded again, so that a change of the method can be judged by the same runs.
#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/trace_writer/temporary_directory.hpp"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kCallbacks = 20;

bool succeeds(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

void run(const std::string& command) {
  if (!succeeds(command)) {
    throw std::runtime_error("failed: " + command);
  }
}

// What compilers do to the machine: a thread for each processor, which works for a while on some megabytes and
// waits for a file now and then.
class OtherPrograms {
 public:
  OtherPrograms() {
    for (unsigned thread = 0; thread < std::max(std::thread::hardware_concurrency(), 1U); ++thread) {
      threads_.emplace_back([this, thread] { work(thread); });
    }
  }
  ~OtherPrograms() {
    ends_ = true;
    for (std::thread& thread : threads_) {
      thread.join();
    }
  }

 private:
  void work(unsigned seed) {
    std::mt19937 random(seed);
    std::vector<unsigned> memory(1U << 20);
    while (!ends_) {
      const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(random() % 500);
      while (!ends_ && std::chrono::steady_clock::now() < end) {
        for (int step = 0; step < 1000; ++step) {
          memory[random() % memory.size()] += random();
        }
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(random() % 30));
    }
  }

  std::atomic<bool> ends_ = false;
  std::vector<std::thread> threads_;
};

json parsed(const fs::path& file) {
  std::ifstream stream(file);
  return json::parse(stream);
}

std::string name_of(int callback) {
  return callback % 2 == 0 ? fmt::format("/source_{}, timer 40 ms", callback / 2)
                           : fmt::format("/sink_{0}, subscription /topic_{0}", callback / 2);
}

using Side = std::vector<fs::path>;  // runs, each a baseline

// One trial: the runs before and after.
struct Trial {
  bool busy;
  std::string shape;  // of the work
  int slow;
  Side before, same, by_time, by_part;
};

class Runs {
 public:
  Runs(fs::path directory, int seconds, int runs) : directory_(std::move(directory)), seconds_(seconds), runs_(runs) {
    fs::create_directories(directory_);
  }

  Trial trial(int number) const {
    Trial trial{number % 2 == 1, number / 2 % 2 == 0 ? "equal" : "varied", number * 7 % kCallbacks, {}, {}, {}, {}};
    std::optional<OtherPrograms> others;
    const auto record = [&](const char* name, int slow, const char* more) {
      Side side;
      for (int run = 0; run < runs_; ++run) {
        const std::string which = run == 0 ? "" : fmt::format("_{}", run);
        side.push_back(directory_ / fmt::format("{}_{}{}.json", number, name, which));
        if (fs::exists(side.back())) {
          continue;
        }
        if (trial.busy && !others) {
          others.emplace();
        }
        record_run(side.back(), trial.shape, slow, more);
      }
      return side;
    };
    trial.before = record("before", -1, "0ms");
    trial.same = record("same", -1, "0ms");
    trial.by_time = record("by_time", trial.slow, "2ms");
    trial.by_part = record("by_part", trial.slow, "20%");
    return trial;
  }

 private:
  void record_run(const fs::path& file, const std::string& shape, int slow, const char* more) const {
    const tracing::testing::TemporaryDirectory directory;
    const std::string home = directory.path().native();
    run(
        fmt::format("cd {0} && ROS_HOME={0} {1} {2} program:={3} directory:=run seconds:={4} shape:={5} slow:={6} "
                    "more:={7} >{0}/output 2>&1",
                    home, LAUNCH_PROGRAM, LAUNCH_FILE, TWENTY_CALLBACKS, seconds_, shape, slow, more));
    run(fmt::format("{} {}/run --save-baseline {} >/dev/null", LAUNCH_REPORT, home, file.native()));
  }

  fs::path directory_;
  int seconds_;
  int runs_;
};

// What a method names: the callbacks, and whether anything else has changed.
struct Named {
  std::set<std::string> callbacks;
  bool others = false;

  bool nothing() const { return callbacks.empty() && !others; }
  bool only(int callback) const { return callbacks == std::set{name_of(callback)}; }
};

fs::path joined(const Side& side, const fs::path& file) {
  json all = parsed(side.front());
  for (auto one = side.begin() + 1; one != side.end(); ++one) {
    all["runs"].push_back(parsed(*one)["runs"][0]);
  }
  std::ofstream(file) << all;
  return file;
}

Named named_by_report(const Side& before, const Side& after) {
  const tracing::testing::TemporaryDirectory directory;
  const fs::path result = directory.path() / "result.json";
  Named named;
  if (!succeeds(fmt::format("{} --diff {} {} --json >{} 2>&1", LAUNCH_REPORT,
                            joined(before, directory.path() / "before.json").native(),
                            joined(after, directory.path() / "after.json").native(), result.native()))) {
    return named;  // too few samples
  }
  const json comparison = parsed(result);
  for (const json& change : comparison["changes"]) {
    if (change["kind"] == "callback") {
      named.callbacks.insert(change["subject"]);
    } else {
      named.others = true;
    }
  }
  return named;
}

double median_of(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

std::map<std::string, std::vector<double>> durations_of(const fs::path& file) {
  std::map<std::string, std::vector<double>> durations;
  const json baseline = parsed(file);
  for (const json& one : baseline["runs"][0]["measurements"]) {
    if (one["kind"] == "callback" && one["quantity"] == "duration") {
      durations[one["subject"]] = one["samples_ns"].get<std::vector<double>>();
    }
  }
  return durations;
}

// The rival: all medians of ten blocks are higher than before, and the median of all is higher by 30 %.
Named named_by_plain_rule(const fs::path& before, const fs::path& after) {
  constexpr std::size_t kBlocks = 10;
  const auto block = [](const std::vector<double>& values, std::size_t number) {
    const auto at = [&](std::size_t place) {
      return values.begin() + static_cast<std::ptrdiff_t>(values.size() * place / kBlocks);
    };
    return median_of(std::vector<double>(at(number), at(number + 1)));
  };
  const auto earlier = durations_of(before);
  Named named;
  for (const auto& [name, later] : durations_of(after)) {
    const auto found = earlier.find(name);
    if (found == earlier.end() || std::min(found->second.size(), later.size()) < kBlocks) {
      continue;
    }
    bool higher = median_of(later) > 1.3 * median_of(found->second);
    for (std::size_t number = 0; number < kBlocks; ++number) {
      higher = higher && block(later, number) > block(found->second, number);
    }
    if (higher) {
      named.callbacks.insert(name);
    }
  }
  return named;
}

// The trials of one condition by one method, which is given both sides.
struct Count {
  int trials = 0;
  int alarms = 0;
  int by_time = 0;
  int by_part = 0;

  void add(const Trial& trial, const Named& same, const Named& time, const Named& part) {
    ++trials;
    alarms += same.nothing() ? 0 : 1;
    by_time += time.only(trial.slow) ? 1 : 0;
    by_part += part.only(trial.slow) ? 1 : 0;
  }
  void print(const char* method, const char* condition) const {
    fmt::print("{:22} {:5}  false alarms {:2} of {:2}, +2 ms {:2} of {:2}, +20 % {:2} of {:2}\n", method, condition,
               alarms, trials, by_time, trials, by_part, trials);
  }
};

void count(int trials, const Runs& runs) {
  Count counts[3][2];
  std::vector<Trial> recorded;
  for (int number = 0; number < trials; ++number) {
    recorded.push_back(runs.trial(number));
    fmt::print(stderr, "trial {} of {}\n", number + 1, trials);
  }
  std::map<std::pair<bool, std::string>, Side> earlier;
  for (const Trial& trial : recorded) {
    const std::size_t busy = trial.busy ? 1 : 0;
    counts[0][busy].add(trial, named_by_report(trial.before, trial.same), named_by_report(trial.before, trial.by_time),
                        named_by_report(trial.before, trial.by_part));
    if (trial.before.size() > 1) {
      continue;
    }
    counts[2][busy].add(trial, named_by_plain_rule(trial.before[0], trial.same[0]),
                        named_by_plain_rule(trial.before[0], trial.by_time[0]),
                        named_by_plain_rule(trial.before[0], trial.by_part[0]));
    Side& before = earlier[{trial.busy, trial.shape}];
    before.push_back(trial.before[0]);
    if (before.size() > 3) {
      before.erase(before.begin());
    }
    if (before.size() == 3) {
      counts[1][busy].add(trial, named_by_report(before, trial.same), named_by_report(before, trial.by_time),
                          named_by_report(before, trial.by_part));
    }
  }
  const bool is_single = recorded.empty() || recorded.front().before.size() == 1;
  const std::array<const char*, 3> methods = {is_single ? "one run before" : "all runs of both sides",
                                              "three runs before", "plain rule, one run"};
  for (std::size_t method = 0; method < (is_single ? methods.size() : 1); ++method) {
    counts[method][0].print(methods[method], "quiet");
    counts[method][1].print(methods[method], "busy");
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const tracing::testing::TemporaryDirectory directory;
    count(argc > 1 ? std::atoi(argv[1]) : 40,
          Runs(argc > 3 ? fs::path(argv[3]) : directory.path(), argc > 2 ? std::atoi(argv[2]) : 6,
               argc > 4 ? std::atoi(argv[4]) : 1));
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_comparison: error: {}\n", error.what());
    return 1;
  }
}
