// SPDX-License-Identifier: Apache-2.0
// A whole trace in memory, for tests: every event with its fields by name.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace test_support {

struct RecordedEvent {
  std::string name;
  std::int64_t timestamp = 0;
  std::int64_t vpid = 0;
  std::int64_t vtid = 0;
  std::int64_t cpu_id = 0;
  std::string procname;
  std::map<std::string, std::uint64_t> numbers;  // pointers, sizes, times, booleans
  std::map<std::string, std::string> texts;
  std::map<std::string, std::vector<std::uint64_t>> arrays;

  // Fails the test and returns 0 or "" when the event has no such field.
  std::uint64_t number(const std::string& field) const;
  std::string text(const std::string& field) const;
};

struct RecordedTrace {
  std::vector<RecordedEvent> events;
  std::uint64_t losses = 0;  // reports of lost events or packets
};

RecordedTrace read_trace(const std::filesystem::path& directory);

}  // namespace test_support
