// SPDX-License-Identifier: Apache-2.0
// Quantities as people read them.
#pragma once

#include <cstdint>
#include <string>

namespace tracing {

// Three digits and a unit: "999 ns", "1.23 us", "45.6 ms", "107 s"; never more than 7 characters below 10,000 s.
std::string format_duration(double nanoseconds);

// "2026-01-01 00:00:00.123456 UTC"
std::string format_time(std::int64_t ns_since_epoch);

// "1 event", "2 events"
std::string format_count(std::uint64_t count, const std::string& noun);

// "999 bytes", "1.2 kB", "34.5 MB"
std::string format_size(std::uint64_t bytes);

}  // namespace tracing
