// SPDX-License-Identifier: Apache-2.0
#include "worker.hpp"

#include <time.h>
#include <unistd.h>

#include <cstdlib>

namespace latency {
namespace {

void sleep_until(std::int64_t time) {
  const timespec at{time / 1'000'000'000, time % 1'000'000'000};
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &at, nullptr);
}

}  // namespace

std::int64_t monotonic_now() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1'000'000'000 + now.tv_nsec;
}

std::string topic_of(std::size_t size_index) {
  return "/bytes_" + std::to_string(kSizes[size_index]);
}

void tell_ready() {
  if (write(STDOUT_FILENO, "R", 1) != 1) {
    std::exit(EXIT_FAILURE);
  }
}

void tell(std::initializer_list<std::int64_t> times) {
  const std::size_t bytes = times.size() * sizeof(std::int64_t);
  if (write(STDOUT_FILENO, times.begin(), bytes) != static_cast<ssize_t>(bytes)) {
    std::exit(EXIT_FAILURE);
  }
}

void wait_for_end() {
  char byte = 0;
  while (read(STDIN_FILENO, &byte, 1) > 0) {
  }
}

void at_pace(std::uint64_t steps, std::int64_t period, const std::function<void(std::uint64_t)>& step) {
  std::int64_t next = monotonic_now();
  while (steps-- > 0) {
    next += period;
    sleep_until(next);
    step(steps);
  }
}

void for_each_batch(const std::function<void(const Batch&)>& run) {
  Batch batch{};
  while (read(STDIN_FILENO, &batch, sizeof batch) == sizeof batch) {
    run(batch);
  }
}

void publish_batches(const std::function<void(std::size_t, std::int64_t)>& publish) {
  for_each_batch([&](const Batch& batch) {
    at_pace(batch.messages, batch.period,
            [&](std::uint64_t remaining) { publish(batch.size_index, static_cast<std::int64_t>(remaining)); });
  });
}

void LatencyLog::received(std::int64_t sent, std::int64_t remaining) {
  add(monotonic_now() - sent, remaining);
}

void LatencyLog::add(std::int64_t latency, std::int64_t remaining) {
  latencies_.push_back(latency);
  if (remaining != 0) {
    return;
  }
  const std::uint64_t count = latencies_.size();
  const std::size_t bytes = count * sizeof latencies_[0];
  if (write(STDOUT_FILENO, &count, sizeof count) != sizeof count ||
      write(STDOUT_FILENO, latencies_.data(), bytes) != static_cast<ssize_t>(bytes)) {
    std::exit(EXIT_FAILURE);
  }
  latencies_.clear();
}

}  // namespace latency
