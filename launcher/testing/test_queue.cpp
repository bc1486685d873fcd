// SPDX-License-Identifier: Apache-2.0
#include "launcher/testing/test_queue.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/signalfd.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <deque>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <list>
#include <map>
#include <system_error>

#include "base/files/unique_fd.hpp"
#include "base/processes/ending_signals.hpp"
#include "base/processes/left_behind.hpp"
#include "base/processes/spawn.hpp"
#include "launcher/process/guardian/guardian.hpp"
#include "launcher/testing/checks/check.hpp"
#include "launcher/testing/engine.hpp"
#include "launcher/testing/failure.hpp"
#include "launcher/testing/seeds.hpp"
#include "launcher/testing/test_process.hpp"

namespace launch {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

namespace {

// What a test may take beyond its own timeout, for its begin and its end. Then it is told to end, and told again.
constexpr std::chrono::seconds kGrace{60};
constexpr std::chrono::seconds kAgain{10};
constexpr int kMostTold = 4;  // then it is killed

std::string read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// The last lines of a file, which may be large.
std::string read_end(const std::string& path, std::streamoff most) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = file.tellg();
  if (size <= most) {
    return read_text(path);
  }
  file.seekg(size - most);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  return text.substr(text.find('\n') + 1);
}

constexpr std::streamoff kShown = 2000;           // of the output of a test without a result
constexpr std::streamoff kOfGuardian = 64 << 10;  // what launch-guardian writes at the end is shorter

// A failure of the whole test. `output` stands below.
TestFailure failure_of_test(const TestCase& test, const std::string& message, const std::string& output = {}) {
  TestFailure failure = as_text(Failure{message, test.where});
  failure.text += output;
  return failure;
}

// "0003-answers_each_message"
std::string directory_name(std::size_t number, const std::string& name) {
  constexpr std::size_t kLongest = 60;
  std::string word = name.substr(0, kLongest);
  std::replace_if(
      word.begin(), word.end(), [](unsigned char c) { return std::isalnum(c) == 0 && c != '-' && c != '.'; }, '_');
  return fmt::format("{:04}-{}", number, word);
}

class Queue {
 public:
  Queue(const std::vector<TestCase>& tests, const Registry& registry, const Environment& environment,
        const LaunchArguments& arguments, const QueueOptions& options, QueueObserver& observer)
      : tests_(tests),
        registry_(registry),
        environment_(environment),
        arguments_(arguments),
        options_(options),
        observer_(observer),
        all_(options.rounds == 0 ? std::numeric_limits<std::size_t>::max() : options.rounds * tests.size()) {
    sigemptyset(&signals_);
    for (const int signal : kEndingSignals) {
      sigaddset(&signals_, signal);
    }
    ::sigprocmask(SIG_BLOCK, &signals_, &before_);
    signal_file_.reset(::signalfd(-1, &signals_, SFD_CLOEXEC | SFD_NONBLOCK));
    if (!signal_file_) {
      throw std::system_error(errno, std::system_category(), "cannot wait for signals");
    }
  }
  ~Queue() { ::sigprocmask(SIG_SETMASK, &before_, nullptr); }
  Queue(const Queue&) = delete;
  Queue& operator=(const Queue&) = delete;

  std::vector<TestResult> run(bool& interrupted) {
    for (;;) {
      while (running_.size() < options_.jobs && may_start()) {
        if (again_.empty()) {
          start(next_++, 1);
        } else {
          const auto [number, attempt] = again_.front();
          again_.pop_front();
          start(number, attempt);
        }
      }
      if (running_.empty()) {
        break;
      }
      wait();
    }
    interrupted = interrupted_;
    std::vector<TestResult> results;
    for (auto& [number, result] : results_) {
      results.push_back(std::move(result));
    }
    return results;
  }

 private:
  struct Running {
    std::size_t number;  // among the tests of all rounds
    std::size_t attempt;
    std::string directory;
    pid_t pid;
    UniqueFd pidfd;
    UniqueFd result;  // of a test that runs here
    Clock::time_point begin;
    Clock::time_point deadline;
    int told = 0;
  };

  const TestCase& test_of(std::size_t number) const { return tests_[number % tests_.size()]; }

  bool may_start() const {
    const bool is_over = interrupted_ || (options_.stop_at_failure && has_failed_);
    return !is_over && (!again_.empty() || next_ < all_);
  }

  void start(std::size_t number, std::size_t attempt) {
    const TestCase& test = test_of(number);
    std::string directory = options_.directory + "/" + directory_name(number + 1, test.full_name());
    if (attempt > 1) {
      directory += fmt::format("-attempt{}", attempt);
    }
    const Clock::time_point now = Clock::now();
    const bool here = options_.engine.empty();
    Running run{.number = number, .attempt = attempt, .directory = directory, .pid = -1, .begin = now};
    // An engine may let a test wait for its turn.
    run.deadline =
        here ? now + std::chrono::duration_cast<Clock::duration>(test.timeout) + kGrace : Clock::time_point::max();
    try {
      fs::create_directories(directory);
      if (here) {
        run.result.reset(::memfd_create("result", MFD_CLOEXEC));
      }
      run.pid = here ? start_test({test, registry_, environment_, arguments_, directory, run.result.get()})
                     : start_in_engine(options_.engine, {test.file, test.name, test.number, arguments_, directory,
                                                         test.seed, test.faults});
    } catch (const std::exception& error) {
      TestResult result{.file = test.file, .name = test.name, .line = test.line};
      result.failures.push_back(failure_of_test(test, fmt::format("the test can't be started: {}", error.what())));
      take(run, std::move(result));
      return;
    }
    run.pidfd.reset(static_cast<int>(::syscall(SYS_pidfd_open, run.pid, 0)));
    running_.push_back(std::move(run));
    tell_progress();
  }

  void wait() {
    std::vector<pollfd> files = {{signal_file_.get(), POLLIN, 0}};
    Clock::time_point deadline = Clock::time_point::max();
    for (const Running& run : running_) {
      files.push_back({run.pidfd.get(), POLLIN, 0});
      deadline = std::min(deadline, run.deadline);
    }
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (::poll(files.data(), files.size(), static_cast<int>(std::clamp<std::int64_t>(left, 0, 1'000'000))) < 0 &&
        errno != EINTR) {
      throw std::system_error(errno, std::system_category(), "cannot wait for tests");
    }
    signalfd_siginfo info{};
    while (::read(signal_file_.get(), &info, sizeof info) == sizeof info) {
      interrupted_ = true;
      for (const Running& run : running_) {
        ::kill(options_.engine.empty() ? run.pid : -run.pid, static_cast<int>(info.ssi_signo));
      }
    }
    std::size_t file = 1;
    for (auto run = running_.begin(); run != running_.end(); ++file) {
      if ((files[file].revents & POLLIN) != 0) {
        end(*run);
        run = running_.erase(run);
        tell_progress();
      } else {
        if (Clock::now() >= run->deadline) {
          ::kill(run->pid, ++run->told > kMostTold ? SIGKILL : SIGTERM);
          run->deadline = Clock::now() + kAgain;
        }
        ++run;
      }
    }
  }

  void end(const Running& run) {
    const int status = wait_for(run.pid);
    TestResult result = result_of(run, status);
    if (interrupted_) {
      result.failures = {failure_of_test(test_of(run.number), "the test was interrupted")};
    }
    take(run, std::move(result));
  }

  void take(const Running& run, TestResult result) {
    if (!interrupted_ && !result.passed() && run.attempt <= options_.retries) {
      first_failures_.try_emplace(run.number, result.failures.front().message);
      again_.emplace_back(run.number, run.attempt + 1);
      return;
    }
    ++ended_;
    result.round = options_.rounds == 1 ? 0 : run.number / tests_.size() + 1;
    result.attempts = run.attempt;
    const TestCase& test = test_of(run.number);
    result.seed_in_name = test.seed_in_name;
    if (test.shows_seed) {
      result.seed = test.seed;
      result.again = command_of(test, arguments_);
    }
    if (const auto first = first_failures_.find(run.number); first != first_failures_.end()) {
      result.earlier = first->second;
    }
    has_failed_ = has_failed_ || !result.passed();
    if (result.passed() && !options_.keep) {
      std::error_code ignored;
      fs::remove_all(run.directory, ignored);
      result.directory.clear();
    }
    observer_.on_result(result);
    results_.emplace(run.number, std::move(result));
  }

  TestResult result_of(const Running& run, int status) const {
    const bool here = options_.engine.empty();
    const std::string output = run.directory + (here ? "/output.txt" : "/engine.txt");
    if (std::optional<TestResult> result = here
                                               ? from_json(read_text(fmt::format("/proc/self/fd/{}", run.result.get())))
                                               : result_of_engine(run.directory)) {
      if (run.told > 0) {
        result->failures.push_back(failure_of_test(test_of(run.number), "the test did not end, and was told to"));
      }
      if (here) {
        // launch-guardian has ended them when the process of the test had written its result.
        for (const std::string& left : left_behind(read_end(output, kOfGuardian))) {
          result->failures.push_back(failure_of_test(test_of(run.number), left));
        }
      }
      result->file = test_of(run.number).file;
      return std::move(*result);
    }
    const TestCase& test = test_of(run.number);
    TestResult result{.file = test.file, .name = test.name, .line = test.line};
    result.seconds = std::chrono::duration<double>(Clock::now() - run.begin).count();
    result.directory = run.directory;
    result.failures.push_back(failure_of_test(
        test,
        fmt::format("the {} has ended with {}, without a result", here ? "process of the test" : "engine",
                    exit_text(WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status))),
        read_end(output, kShown)));
    return result;
  }

  void tell_progress() {
    std::vector<std::string> names;
    for (const Running& run : running_) {
      names.push_back(test_of(run.number).full_name());
    }
    observer_.on_progress(ended_, all_, names);
  }

  const std::vector<TestCase>& tests_;
  const Registry& registry_;
  const Environment& environment_;
  const LaunchArguments& arguments_;
  const QueueOptions& options_;
  QueueObserver& observer_;
  const std::size_t all_;  // tests of all rounds
  std::map<std::size_t, TestResult> results_;
  std::map<std::size_t, std::string> first_failures_;
  std::deque<std::pair<std::size_t, std::size_t>> again_;  // test, attempt
  bool has_failed_ = false;
  std::list<Running> running_;
  std::size_t next_ = 0;
  std::size_t ended_ = 0;
  bool interrupted_ = false;
  sigset_t signals_{};
  sigset_t before_{};
  UniqueFd signal_file_;
};

}  // namespace

std::vector<TestResult> run_tests(const std::vector<TestCase>& tests, const Registry& registry,
                                  const Environment& environment, const LaunchArguments& arguments,
                                  const QueueOptions& options, QueueObserver& observer, bool& interrupted) {
  return Queue(tests, registry, environment, arguments, options, observer).run(interrupted);
}

}  // namespace launch
