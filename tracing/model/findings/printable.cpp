// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/findings/printable.hpp"

#include <algorithm>
#include <cstdint>

namespace tracing {

namespace {

// The bytes of the character of UTF-8 that the text begins with, if it may be printed; 0 otherwise.
std::size_t printable_bytes(std::string_view text) {
  const auto byte = [text](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint8_t first = byte(0);
  if (first < 0x80) {
    return first < 0x20 || first == 0x7f ? 0 : 1;
  }
  const std::size_t length = first >= 0xc2 && first < 0xe0   ? 2
                             : first >= 0xe0 && first < 0xf0 ? 3
                             : first >= 0xf0 && first < 0xf5 ? 4
                                                             : 0;
  if (length == 0 || length > text.size()) {
    return 0;
  }
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) {
      return 0;
    }
  }
  const std::uint8_t second = byte(1);
  const bool is_control = first == 0xc2 && second < 0xa0;
  const bool is_too_long = (first == 0xe0 && second < 0xa0) || (first == 0xf0 && second < 0x90);
  const bool is_no_character = (first == 0xed && second >= 0xa0) || (first == 0xf4 && second >= 0x90);
  return is_control || is_too_long || is_no_character ? 0 : length;
}

void clean(std::string& text) {
  const auto is_plain = [](char c) { return c >= 0x20 && c < 0x7f; };
  if (!std::all_of(text.begin(), text.end(), is_plain)) {
    text = printable(text);
  }
}

void clean(std::vector<std::string>& texts) {
  for (std::string& text : texts) {
    clean(text);
  }
}

// The texts of every field.
template <HasFields Result>
void clean(std::vector<Result>& results) {
  for (Result& result : results) {
    for (const Field<Result>& field : Result::kFields) {
      if (std::string* const text = field.member.text_in(result)) {
        clean(*text);
      }
    }
  }
}

}  // namespace

std::string printable(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t bytes = printable_bytes(text);
    if (bytes == 0) {
      result += '?';
    } else {
      result += text.substr(0, bytes);
    }
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return result;
}

TraceResults printable(TraceResults results) {
  clean(results.overview.processes);
  clean(results.overview.event_counts);
  clean(results.overview.losses);
  Ros2Results& ros2 = results.ros2;
  clean(ros2.callbacks);
  clean(ros2.topics);
  clean(ros2.subscriptions);
  clean(ros2.executors);
  clean(ros2.chains);
  for (ChainResult& one : ros2.chains) {
    clean(one.steps);
  }
  clean(ros2.unseen_chains);
  clean(ros2.lifecycle);
  clean(ros2.calls);
  clean(ros2.actions);
  clean(ros2.nodes);
  clean(ros2.executions);
  clean(results.starts);
  clean(results.launcher_events);
  if (results.startup) {
    clean(results.startup->critical_path);
  }
  clean(results.warnings);
  clean(ros2.remarks);
  clean(ros2.tracetools);
  return results;
}

}  // namespace tracing
