// SPDX-License-Identifier: Apache-2.0
// Makes a bundle of each crash of the processes whose spec has a crash directory. A crash is an end that nobody asked
// for and that the spec does not allow. A process that misses a deadline or is unhealthy, and runs on, gets a bundle,
// too.
//
// The work is done on a thread of its own, one bundle after the other, because a debugger takes seconds.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "launcher/crash/crash_bundle.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/process/process_event.hpp"

namespace launch {

class CrashCollector {
 public:
  // A process that crashes, or misses a deadline, more often gets no further bundle.
  static constexpr std::size_t kMostOfOneProcess = 5;
  // So much of the output of each process is kept.
  static constexpr std::size_t kLines = 1000;
  static constexpr std::size_t kBytes = 64UL << 10U;

  using Tell = std::function<void(bool warning, const std::string& text)>;

  // `tell` is called on the loop's thread. The loop must outlive the collector.
  CrashCollector(EventLoop& loop, Tell tell);
  ~CrashCollector();
  CrashCollector(const CrashCollector&) = delete;
  CrashCollector& operator=(const CrashCollector&) = delete;

  // From now on, lines of output are wanted.
  void expect(const ProcessSpec& spec) { watches_ = watches_ || !spec.crash_directory.empty(); }
  bool watch_output() const { return watches_; }

  void on_line(const ProcessSpec& spec, ProcessId id, std::string_view line);
  void on_process_event(const ProcessEvent& event);
  // A flight recorder has written what happened before. A reason that is a crash begins with the label of a process.
  // `late`: the events by which processes have said that they missed a deadline, if reasons are such.
  void on_snapshot(const std::vector<std::string>& reasons, const std::filesystem::path& directory,
                   const std::vector<std::string>& late);

  // The process is unhealthy, and runs on. Calls `done` when there is a bundle, in a later turn of the loop, or at once
  // when there will be none.
  void on_unhealthy(ProcessId id, const std::string& reason, std::function<void()> done);

  // Calls `done` in a later turn of the loop, when all bundles are complete; at once if there is none to wait for.
  void finish(std::function<void()> done);
  // The user is in a hurry: debuggers are ended.
  void hurry() { hurry_ = true; }

 private:
  struct Output {
    std::deque<std::string> lines;
    std::size_t bytes = 0;
  };
  using Job = std::function<void()>;

  // The last run of a process. The references are valid as long as the supervisor.
  struct Run {
    pid_t pid;
    const std::string& label;
    const ProcessSpec& spec;
  };

  void collect(const ProcessEvent& event, const ProcessExited& exited);
  Crash describe_run(ProcessId id, const Run& run) const;
  void find_late(const std::vector<std::string>& reasons, const std::filesystem::path& snapshot,
                 const std::vector<std::string>& events);
  void collect_late(pid_t pid, const std::vector<std::string>& reasons, const std::filesystem::path& snapshot);
  bool is_idle();
  void add(Job job);
  void work();
  void tell_later(bool warning, std::string text);

  EventLoop& loop_;
  Tell tell_;
  bool watches_ = false;
  std::map<ProcessId, Output> output_;
  std::map<ProcessId, std::size_t> crashes_;
  std::map<ProcessId, std::size_t> missed_;  // deadlines
  std::map<ProcessId, std::size_t> unhealthy_;
  std::map<ProcessId, Run> runs_;  // of processes with a crash directory

  std::atomic<bool> hurry_ = false;
  std::map<std::string, std::filesystem::path> last_bundle_;  // of each process; for the thread alone
  std::map<pid_t, std::int64_t> last_missed_;                 // deadline that is told; for the thread alone
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> jobs_;
  bool stop_ = false;
  bool works_ = false;
  std::thread thread_;
};

}  // namespace launch
