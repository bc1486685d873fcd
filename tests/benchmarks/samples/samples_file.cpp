// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/samples/samples_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>
#include <fstream>

namespace benchmarks {

void report(const Samples& samples) {
  const char* const path = std::getenv("BENCHMARK_SAMPLES");
  if (path == nullptr) {
    return;
  }
  // The names are those of the benchmarks; nothing in them needs an escape.
  std::ofstream(path, std::ios::app) << fmt::format(
      R"({{"name": "{}", "unit": "{}", "values": [{}], "floor_name": "{}", "floor": [{}], "better": "{}"}})"
      "\n",
      samples.name, samples.unit, fmt::join(samples.values, ", "), samples.floor_name, fmt::join(samples.floor, ", "),
      samples.higher_is_better ? "higher" : "lower");
}

}  // namespace benchmarks
