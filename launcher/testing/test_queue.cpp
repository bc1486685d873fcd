// SPDX-License-Identifier: Apache-2.0
#include "launcher/testing/test_queue.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
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

#include "launcher/base/ending_signals.hpp"
#include "launcher/base/spawn.hpp"
#include "launcher/base/unique_fd.hpp"
#include "launcher/testing/checks/check.hpp"
#include "launcher/testing/engine.hpp"
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

std::string last_part(const std::string& text) {
  constexpr std::size_t kMost = 2000;
  return text.size() <= kMost ? text : text.substr(text.find('\n', text.size() - kMost) + 1);
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
    fs::create_directories(directory);
    const Clock::time_point now = Clock::now();
    const bool here = options_.engine.empty();
    const pid_t pid =
        here ? start_test({test, registry_, environment_, arguments_, directory})
             : start_in_engine(options_.engine, {test.file, test.name, arguments_, directory, test.seed, test.faults});
    // An engine may let a test wait for its turn.
    running_.push_back(
        {number, attempt, directory, pid, UniqueFd(static_cast<int>(::syscall(SYS_pidfd_open, pid, 0))), now,
         here ? now + std::chrono::duration_cast<Clock::duration>(test.timeout) + kGrace : Clock::time_point::max()});
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
      result.failures = {{.message = "the test was interrupted", .text = "error: the test was interrupted\n"}};
    } else if (!result.passed() && run.attempt <= options_.retries) {
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
    if (std::optional<TestResult> result = options_.engine.empty() ? from_json(read_text(result_file(run.directory)))
                                                                   : result_of_engine(run.directory)) {
      if (run.told > 0) {
        const std::string text = "the test did not end, and was told to";
        result->failures.push_back({.message = text, .text = fmt::format("error: {}\n", text)});
      }
      result->file = test_of(run.number).file;
      return std::move(*result);
    }
    const TestCase& test = test_of(run.number);
    TestResult result{.file = test.file, .name = test.name, .line = test.line};
    result.seconds = std::chrono::duration<double>(Clock::now() - run.begin).count();
    result.directory = run.directory;
    const std::string text = fmt::format("the {} has ended with {}, without a result",
                                         options_.engine.empty() ? "process of the test" : "engine",
                                         exit_text(WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status)));
    result.failures.push_back(
        {.message = text,
         .text = fmt::format(
             "error: {}\n{}", text,
             last_part(read_text(run.directory + (options_.engine.empty() ? "/output.txt" : "/engine.txt"))))});
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
