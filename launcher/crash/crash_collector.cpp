// SPDX-License-Identifier: Apache-2.0
#include "launcher/crash/crash_collector.hpp"

#include <fmt/format.h>

#include <exception>
#include <memory>
#include <utility>

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
  if (const auto* const exited = std::get_if<ProcessExited>(&event.what)) {
    if (!exited->expected && !event.spec.allowed_exits.contains(exited->exit.code)) {
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
  Crash crash;
  crash.process = event.label;
  crash.pid = exited.pid;
  crash.exit = exited.exit;
  crash.time = std::chrono::system_clock::now();
  crash.place = event.spec.origin ? place_with_path(event.spec.origin) : "";
  crash.argv = event.spec.argv;
  crash.shell = event.spec.shell;
  crash.environment = event.spec.environment.variables();
  std::error_code unknown;
  crash.directory = std::filesystem::current_path(unknown).string();
  if (!event.spec.working_directory.empty()) {
    crash.directory = (std::filesystem::path(crash.directory) / event.spec.working_directory).string();
  }
  const Output& output = output_[event.id];
  crash.last_lines.assign(output.lines.begin(), output.lines.end());
  add([this, crash = std::move(crash), parent = std::filesystem::path(event.spec.crash_directory)] {
    const std::filesystem::path bundle = write_crash_bundle(crash, parent, hurry_);
    last_bundle_[crash.process] = bundle;
    tell_later(false, fmt::format("crash bundle of {}: {}", crash.process, bundle.string()));
  });
}

void CrashCollector::on_snapshot(const std::vector<std::string>& reasons, const std::filesystem::path& directory) {
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

void CrashCollector::finish(std::function<void()> done) {
  if (!thread_.joinable()) {
    loop_.post(std::move(done));
    return;
  }
  add([this, done = std::move(done)] { loop_.post(done); });
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
      changed_.wait(lock, [this] { return stop_ || !jobs_.empty(); });
      if (stop_) {
        return;
      }
      job = std::move(jobs_.front());
      jobs_.pop_front();
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
