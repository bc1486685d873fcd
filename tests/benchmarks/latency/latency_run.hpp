// SPDX-License-Identifier: Apache-2.0
// A publishing and a subscribing process, and the latencies between them.
#pragma once

#include <sys/types.h>

#include <map>
#include <string>
#include <vector>

#include "worker.hpp"

namespace latency {

// A program with pipes as stdin and stdout; it is killed at the end of the scope.
class Worker {
 public:
  // Runs on the `processor`-th of the processors that this process may use.
  Worker(const std::vector<std::string>& argv, const std::map<std::string, std::string>& environment, int processor);
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  void send(const void* bytes, std::size_t length);
  // Fails when the worker ends, or is silent for ten seconds.
  void receive(void* bytes, std::size_t length);

 private:
  std::string name_;
  pid_t pid_ = -1;
  int in_ = -1;
  int out_ = -1;
};

// Each runs on a processor of its own: the placement of threads by the scheduler makes more difference than the
// measured effect.
class Pair {
 public:
  Pair(const std::string& program, const std::string& subscriber_role,
       const std::map<std::string, std::string>& environment);

  void wait_ready();
  // The time of each message that came, in nanoseconds, from before the publication to within the callback. A late
  // reader misses all messages that the writer no longer keeps, except the last one.
  std::vector<std::int64_t> run(const Batch& batch);

 private:
  Worker subscriber_;
  Worker publisher_;
};

// Throws what main() reports: the benchmark cannot go on.
[[noreturn]] void fail(const std::string& message);

}  // namespace latency
