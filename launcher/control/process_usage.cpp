// SPDX-License-Identifier: Apache-2.0
#include "launcher/control/process_usage.hpp"

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <utility>

namespace launch {

namespace {

// A thread takes as long to start as a dozen processes to be looked at.
constexpr std::size_t kWorthThreads = 200;
constexpr std::size_t kMostThreads = 4;
constexpr std::size_t kBatch = 50;

}  // namespace

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
