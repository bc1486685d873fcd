// SPDX-License-Identifier: Apache-2.0
// A publishing and a subscribing process, and the latencies between them.
#pragma once

#include <sys/types.h>

#include <map>
#include <string>
#include <vector>

#include "worker.hpp"

namespace latency {

// A program on stdin and stdout pipes; killed at the end of scope.
class Worker {
 public:
  // Runs on the `processor`-th of those that this process may use.
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

// On a processor each: where the scheduler happens to place threads makes more of a difference than what is measured.
class Pair {
 public:
  Pair(const std::string& program, const std::string& subscriber_role,
       const std::map<std::string, std::string>& environment);

  void wait_ready();
  // Nanoseconds from before the publication to within the callback, of each message that came: a late
  // reader misses what the writer no longer keeps, except the last one.
  std::vector<std::int64_t> run(const Batch& batch);

 private:
  Worker subscriber_;
  Worker publisher_;
};

// Throws what main() reports: the benchmark cannot go on.
[[noreturn]] void fail(const std::string& message);

}  // namespace latency
