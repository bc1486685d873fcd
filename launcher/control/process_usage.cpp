// SPDX-License-Identifier: Apache-2.0
#include "launcher/control/process_usage.hpp"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/files/unique_fd.hpp"

namespace launch {

namespace {

// A thread takes as long to start as a dozen processes to be looked at.
constexpr std::size_t kWorthThreads = 200;
constexpr std::size_t kMostThreads = 4;
constexpr std::size_t kBatch = 50;

// As clock_getcpuclockid(3), which asks the kernel whether there is such a process: so does the reading of the clock.
clockid_t clock_of(pid_t pid) {
  constexpr clockid_t kAllThreadsScheduled = 2;  // CPUCLOCK_SCHED of the kernel
  return static_cast<clockid_t>(~static_cast<unsigned>(pid) << 3U) | kAllThreadsScheduled;
}

}  // namespace

// The times in /proc/PID/stat are whole ticks, so the clock of the process tells the time.
std::optional<ProcessUsage> read_process_usage(pid_t pid) {
  static const auto kPage = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  constexpr double kNanosecond = 1e-9;

  timespec used{};
  if (pid <= 0 || ::clock_gettime(clock_of(pid), &used) != 0) {
    return std::nullopt;
  }
  std::array<char, 32> path{};
  ::snprintf(path.data(), path.size(), "/proc/%d/stat", pid);
  const UniqueFd file(::open(path.data(), O_RDONLY | O_CLOEXEC));
  std::array<char, 1024> text;  // not initialised: it is read into
  const ssize_t size = file ? ::read(file.get(), text.data(), text.size() - 1) : -1;
  if (size <= 0) {
    return std::nullopt;
  }
  text[static_cast<std::size_t>(size)] = '\0';
  // "pid (name) state …", and the name may have brackets and spaces. The pages that are resident are field 21 from
  // there.
  constexpr int kFieldOfPages = 21;
  const char* const name_end = ::strrchr(text.data(), ')');
  if (name_end == nullptr || name_end[1] == '\0') {
    return std::nullopt;
  }
  const char* resident = name_end + 2;
  const char state = *resident;
  for (int field = 0; field < kFieldOfPages && resident != nullptr; ++field) {
    resident = ::strchr(resident, ' ');
    resident = resident == nullptr ? nullptr : resident + 1;
  }
  ProcessUsage usage;
  usage.stopped = state == 'T' || state == 't';
  usage.cpu = static_cast<double>(used.tv_sec) + static_cast<double>(used.tv_nsec) * kNanosecond;
  usage.memory = resident == nullptr ? 0 : ::strtoull(resident, nullptr, 10) * kPage;
  return usage;
}

UsageReader::~UsageReader() {
  {
    const std::lock_guard lock(mutex_);
    complete_ = true;
    begun_ = pids_.size();
  }
  more_.notify_all();
}

void UsageReader::add(pid_t pid) {
  std::size_t size = 0;
  {
    const std::lock_guard lock(mutex_);
    pids_.push_back(pid);
    size = pids_.size();
  }
  if (size == kWorthThreads) {
    begin_threads();
  } else if (size % kBatch == 0) {
    more_.notify_one();
  }
}

void UsageReader::begin_threads() {
  const std::size_t processors = std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, kMostThreads);
  for (std::size_t thread = 1; thread < processors; ++thread) {
    others_.emplace_back([this] { read(); });
  }
}

std::vector<std::optional<ProcessUsage>> UsageReader::take() {
  {
    const std::lock_guard lock(mutex_);
    complete_ = true;
  }
  more_.notify_all();
  read();
  others_.clear();  // waits for them
  return std::move(usage_);
}

void UsageReader::read() {
  std::vector<pid_t> batch;
  std::vector<std::optional<ProcessUsage>> found;
  std::unique_lock lock(mutex_);
  for (;;) {
    more_.wait(lock, [this] { return complete_ || pids_.size() - begun_ >= kBatch; });
    const std::size_t begin = begun_;
    begun_ = std::min(begin + kBatch, pids_.size());
    batch.assign(pids_.begin() + static_cast<std::ptrdiff_t>(begin),
                 pids_.begin() + static_cast<std::ptrdiff_t>(begun_));
    if (batch.empty()) {
      return;
    }
    lock.unlock();
    found.clear();
    for (const pid_t pid : batch) {
      found.push_back(read_process_usage(pid));
    }
    lock.lock();
    usage_.resize(pids_.size());
    std::copy(found.begin(), found.end(), usage_.begin() + static_cast<std::ptrdiff_t>(begin));
  }
}

void add_usage(nlohmann::ordered_json& processes) {
  UsageReader reader;
  for (const nlohmann::ordered_json& process : processes) {
    reader.add(process.value("pid", -1));
  }
  const std::vector<std::optional<ProcessUsage>> usage = reader.take();
  for (std::size_t i = 0; i < usage.size(); ++i) {
    if (usage[i]) {
      processes[i]["cpu"] = usage[i]->cpu;
      processes[i]["memory"] = usage[i]->memory;
      if (usage[i]->stopped && processes[i].value("state", "") == "running") {
        processes[i]["state"] = "stopped";
      }
    }
  }
}

}  // namespace launch
