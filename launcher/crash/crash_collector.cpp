// SPDX-License-Identifier: Apache-2.0
#include "launcher/crash/crash_collector.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <utility>

#include "launcher/crash/late_processes.hpp"

namespace launch {

CrashCollector::CrashCollector(EventLoop& loop, Tell tell) : loop_(loop), tell_(std::move(tell)) {}

CrashCollector::~CrashCollector() {
  hurry_ = true;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  changed_.notify_one();
  if (thread_.joinable()) {
    thread_.join();
  }
}

void CrashCollector::on_line(const ProcessSpec& spec, ProcessId id, std::string_view line) {
  if (spec.crash_directory.empty()) {
    return;
  }
  Output& output = output_[id];
  output.bytes += line.size();
  output.lines.emplace_back(line);
  while (output.lines.size() > kLines || (output.bytes > kBytes && output.lines.size() > 1)) {
    output.bytes -= output.lines.front().size();
    output.lines.pop_front();
  }
}

void CrashCollector::on_process_event(const ProcessEvent& event) {
  if (event.spec.crash_directory.empty()) {
    return;
  }
  if (const auto* const started = std::get_if<ProcessStarted>(&event.what)) {
    runs_.erase(event.id);
    runs_.emplace(event.id, Run{started->pid, event.label, event.spec});
  } else if (const auto* const exited = std::get_if<ProcessExited>(&event.what)) {
    if (has_failed(event.spec, *exited)) {
      collect(event, *exited);
    }
    output_.erase(event.id);
  }
}

void CrashCollector::collect(const ProcessEvent& event, const ProcessExited& exited) {
  const std::size_t count = ++crashes_[event.id];
  if (count > kMostOfOneProcess) {
    if (count == kMostOfOneProcess + 1) {
      tell_(true, fmt::format("{} has crashed {} times; there are no more crash bundles of it", event.label, count));
    }
    return;
  }
  Crash crash = describe_run(event.id, {exited.pid, event.label, event.spec});
  crash.exit = exited.exit;
  add([this, crash = std::move(crash), parent = std::filesystem::path(event.spec.crash_directory)] {
    const std::filesystem::path bundle = write_crash_bundle(crash, parent, hurry_);
    last_bundle_[crash.process] = bundle;
    tell_later(false, fmt::format("crash bundle of {}: {}", crash.process, bundle.string()));
  });
}

Crash CrashCollector::describe_run(ProcessId id, const Run& run) const {
  Crash crash;
  crash.process = run.label;
  crash.pid = run.pid;
  crash.time = std::chrono::system_clock::now();
  crash.place = run.spec.origin ? place_with_path(run.spec.origin) : "";
  crash.argv = run.spec.argv;
  crash.shell = run.spec.shell;
  crash.environment = run.spec.environment.variables();
  std::error_code unknown;
  crash.directory = std::filesystem::current_path(unknown).string();
  if (!run.spec.working_directory.empty()) {
    crash.directory = (std::filesystem::path(crash.directory) / run.spec.working_directory).string();
  }
  if (const auto output = output_.find(id); output != output_.end()) {
    crash.last_lines.assign(output->second.lines.begin(), output->second.lines.end());
  }
  return crash;
}

void CrashCollector::on_snapshot(const std::vector<std::string>& reasons, const std::filesystem::path& directory,
                                 const std::vector<std::string>& late) {
  if (!late.empty() && !runs_.empty()) {
    add([this, reasons, directory, late] { find_late(reasons, directory, late); });
  }
  if (crashes_.empty()) {
    return;
  }
  add([this, reasons, directory] {
    for (const auto& [process, bundle] : last_bundle_) {
      for (const std::string& reason : reasons) {
        if (reason.starts_with(process + " ")) {
          add_snapshot(bundle, directory);
        }
      }
    }
  });
}

// On the thread. Snapshots clear nothing, so one holds the missed deadlines of the one before, too.
void CrashCollector::find_late(const std::vector<std::string>& reasons, const std::filesystem::path& snapshot,
                               const std::vector<std::string>& events) {
  for (const auto& [pid, time] : late_processes(snapshot, events, hurry_)) {
    std::int64_t& told = last_missed_[pid];
    if (time > told) {
      told = time;
      loop_.post([this, late = pid, reasons, snapshot] { collect_late(late, reasons, snapshot); });
    }
  }
}

void CrashCollector::collect_late(pid_t pid, const std::vector<std::string>& reasons,
                                  const std::filesystem::path& snapshot) {
  const pid_t group = ::getpgid(pid);  // a script may have started the program that was late
  const auto found = std::find_if(runs_.begin(), runs_.end(),
                                  [&](const auto& run) { return run.second.pid == pid || run.second.pid == group; });
  if (found == runs_.end() || missed_[found->first] >= kMostOfOneProcess) {
    return;
  }
  const auto& [id, run] = *found;
  if (++missed_[id] == kMostOfOneProcess) {
    tell_(true, fmt::format("{} has missed a deadline {} times; this is the last bundle of one", run.label,
                            kMostOfOneProcess));
  }
  add([this, late = describe_run(id, run), reasons, snapshot,
       parent = std::filesystem::path(run.spec.crash_directory)] {
    const std::filesystem::path bundle = write_deadline_bundle(late, reasons, parent);
    add_snapshot(bundle, snapshot);
    tell_later(false, fmt::format("bundle of a deadline that {} has missed: {}", late.process, bundle.string()));
  });
}

void CrashCollector::on_unhealthy(ProcessId id, const std::string& reason, std::function<void()> done) {
  const auto found = runs_.find(id);
  if (found == runs_.end() || unhealthy_[id] >= kMostOfOneProcess) {
    done();
    return;
  }
  const Run& run = found->second;
  if (++unhealthy_[id] == kMostOfOneProcess) {
    tell_(true,
          fmt::format("{} has been unhealthy {} times; this is the last bundle of it", run.label, kMostOfOneProcess));
  }
  add([this, process = describe_run(id, run), reason, done = std::move(done),
       parent = std::filesystem::path(run.spec.crash_directory)] {
    try {
      const std::filesystem::path bundle = write_deadline_bundle(process, {reason}, parent, "health.txt");
      tell_later(false, fmt::format("bundle of {}, which is unhealthy: {}", process.process, bundle.string()));
    } catch (const std::exception& error) {
      tell_later(true, fmt::format("no bundle: {}", error.what()));
    }
    loop_.post(done);
  });
}

void CrashCollector::finish(std::function<void()> done) {
  if (is_idle()) {
    loop_.post(std::move(done));
    return;
  }
  // A job may have asked the loop for another one, which comes before this.
  add([this, done = std::move(done)] { loop_.post([this, done] { finish(done); }); });
}

bool CrashCollector::is_idle() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return jobs_.empty() && !works_;
}

void CrashCollector::add(Job job) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    jobs_.push_back(std::move(job));
  }
  if (!thread_.joinable()) {
    thread_ = std::thread([this] { work(); });
  }
  changed_.notify_one();
}

void CrashCollector::work() {
  for (;;) {
    Job job;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      works_ = false;
      changed_.wait(lock, [this] { return stop_ || !jobs_.empty(); });
      if (stop_) {
        return;
      }
      job = std::move(jobs_.front());
      jobs_.pop_front();
      works_ = true;
    }
    try {
      job();
    } catch (const std::exception& error) {
      tell_later(true, fmt::format("no crash bundle: {}", error.what()));
    }
  }
}

void CrashCollector::tell_later(bool warning, std::string text) {
  loop_.post([this, warning, text = std::move(text)] { tell_(warning, text); });
}

}  // namespace launch
