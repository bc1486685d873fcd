// SPDX-License-Identifier: Apache-2.0
// Writes the results of perf_test as a table (.csv) or for programs (.json).
#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "latency_statistics.hpp"
#include "settings.hpp"

namespace performance_test {

// The counts of an interval of time.
struct Interval {
  double end = 0;     // s since the start
  double length = 0;  // s
  uint64_t sent = 0;
  uint64_t received = 0;
  uint64_t lost = 0;
  uint64_t bytes_received = 0;
  LatencySummary latency;
};

// Writes during the run, so results remain if the program is killed. A JSON file is complete only after finish().
class LogFile {
 public:
  // With an empty path nothing is written. Throws std::runtime_error if the file cannot be created.
  explicit LogFile(const Settings& settings);

  void add(const Interval& interval);
  void finish(const Interval& whole);

 private:
  bool is_json_;
  bool is_first_ = true;
  std::ofstream file_;
};

}  // namespace performance_test
