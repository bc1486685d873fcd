// SPDX-License-Identifier: Apache-2.0
// Writes the trace of a system of three processes, with everything that a page shows. All times are known:
//
//   sensor (101): node /sensor has a timer of 10 ms that publishes /scan.
//   filter (102): node /filter gets /scan and publishes /points.
//   display (103): lifecycle node /display gets /points. It is configured and activated at the begin.
//
// In each cycle of 10 ms, the first of which begins 20 ms after the trace:
//   0 us    the timer's callback begins (1 ms late in every tenth cycle), and takes 200 us
//   100 us  /scan is published; taken at 250 us; the callback begins at 300 us and takes 400 us (4 ms in every
//           twentieth cycle)
//   600 us  /points is published (100 us before the end of the callback); taken 150 us later, the callback begins 200
//   us
//           after it and takes 50 us. Nobody takes the /points of every fiftieth cycle.
//
// With events of the kernel's scheduler, these tell of the thread of filter: it is woken 20 us before it takes /scan,
// and runs 10 us later. In a callback of 400 us it sleeps for 100 us and then waits 20 us for a processor. In a
// callback of 4 ms it waits 3.5 ms, while "stress" has the processor.
#pragma once

#include <cstdint>
#include <filesystem>

namespace tracing::testing {

// 2026-01-01 00:00:00 UTC
inline constexpr std::int64_t kExampleBegin = 1'767'225'600'000'000'000;
inline constexpr std::int64_t kExampleFirstCycle = kExampleBegin + 20'000'000;
inline constexpr std::int64_t kExamplePeriod = 10'000'000;

enum class ExampleEvents { kRos, kRosAndScheduler };

struct ExampleVariant {
  std::int64_t usual_us = 400;  // how long the callback of /filter takes, in most cycles
  bool has_links = false;       // /filter declares that it publishes what it keeps of /scan
  bool has_writes = false;      // dds:write, 3 us after rmw_publish: two more events in a cycle
  // As nodes of ROS 2 Iron record it under `ros2 trace`: rmw_publish has the message alone, the timestamp is taken 5 us
  // after it, and there is no launcher.
  bool is_older = false;
  bool has_source_timestamps = true;  // rmw_take has them
};

// Creates the directory. A cycle has 28 events, and at most 7 of the scheduler.
void write_example_system(const std::filesystem::path& directory, std::uint64_t cycles,
                          ExampleEvents events = ExampleEvents::kRos, const ExampleVariant& variant = {});

}  // namespace tracing::testing
