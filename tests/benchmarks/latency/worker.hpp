// SPDX-License-Identifier: Apache-2.0
// The common part of the publishing and subscribing programs of the latency benchmark: the sizes, the pace, and the
// exchange with bench_latency over stdin and stdout.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

namespace latency {

inline constexpr std::array<std::size_t, 4> kSizes = {1024, 32 * 1024, 64 * 1024, 256 * 1024};
inline constexpr int kDepth = 10;

std::int64_t monotonic_now();  // nanoseconds

// The topic of messages of one size, as ROS names it.
std::string topic_of(std::size_t size_index);

// A batch of messages of one size. bench_latency writes it to the stdin of a publisher, as it is in memory.
struct Batch {
  std::uint64_t size_index;
  std::uint64_t messages;
  std::int64_t period;  // nanoseconds from one message to the next
};

// The cost of the tracepoints on the way of a message, in microseconds. First the sum of the costs of each in a loop of
// its own, where everything that they touch is in the caches. Then the costs when they are called once a period, after
// a copy of as many bytes as the message has: those of the publisher one after another, and those of the subscriber.
struct PathRequest {
  std::int64_t period;  // nanoseconds
  std::uint64_t bytes;
};
struct PathCosts {
  double in_a_loop;
  double at_pace;
};

// Writes times to stdout, as they are in memory.
void tell(std::initializer_list<std::int64_t> times);

// Returns when stdin ends: the measuring program has what it wanted.
void wait_for_end();

// Tells bench_latency that every topic has found its other side. Call it once.
void tell_ready();

// Hands over the batches that are asked for until stdin ends.
void for_each_batch(const std::function<void(const Batch&)>& run);

// Calls `step` once a period (nanoseconds), with the number of steps that are left.
void at_pace(std::uint64_t steps, std::int64_t period, const std::function<void(std::uint64_t remaining)>& step);

// Sends the batches that are asked for, each at its pace.
void publish_batches(const std::function<void(std::size_t size_index, std::int64_t remaining)>& publish);

// Collects latencies; after the last message of a batch they go to stdout: their number as uint64, then each as
// int64 nanoseconds. One thread at a time.
class LatencyLog {
 public:
  void received(std::int64_t sent, std::int64_t remaining);
  void add(std::int64_t latency, std::int64_t remaining);

 private:
  std::vector<std::int64_t> latencies_;
};

}  // namespace latency
