// SPDX-License-Identifier: Apache-2.0
// What a benchmark has measured, for programs: `./dev evaluate` and `./dev bench --record` make intervals of it.
#pragma once

#include <string>
#include <vector>

namespace benchmarks {

struct Samples {
  std::string name;
  std::string unit;
  std::vector<double> values;      // one for each run
  std::string floor_name = {};     // empty: it has no floor
  std::vector<double> floor = {};  // of the same runs
  bool higher_is_better = false;
};

// Appends a line of JSON to the file that the environment variable BENCHMARK_SAMPLES names. Does nothing without it.
void report(const Samples& samples);

}  // namespace benchmarks
