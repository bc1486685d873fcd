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

template <class... Texts>
void clean_all(Texts&... texts) {
  (clean(texts), ...);
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
  for (ProcessResult& one : results.overview.processes) {
    clean_all(one.name, one.host);
  }
  for (EventCount& one : results.overview.event_counts) {
    clean(one.name);
  }
  for (LossResult& one : results.overview.losses) {
    clean(one.stream);
  }
  Ros2Results& ros2 = results.ros2;
  for (CallbackResult& one : ros2.callbacks) {
    clean_all(one.node, one.owner_name, one.symbol, one.ran_instead);
  }
  for (TopicResult& one : ros2.topics) {
    clean(one.name);
  }
  for (SubscriptionResult& one : ros2.subscriptions) {
    clean_all(one.node, one.topic);
  }
  for (ExecutorResult& one : ros2.executors) {
    clean(one.longest_callback);
  }
  for (ChainResult& one : ros2.chains) {
    clean(one.name);
    for (ChainResult::Step& step : one.steps) {
      clean_all(step.node, step.callback, step.topic);
    }
  }
  for (std::string& one : ros2.unseen_chains) {
    clean(one);
  }
  for (LifecycleResult& one : ros2.lifecycle) {
    clean_all(one.node, one.state);
  }
  for (CallResult& one : ros2.calls) {
    clean_all(one.service, one.client, one.server);
  }
  for (ActionResult& one : ros2.actions) {
    clean_all(one.name, one.client, one.server);
  }
  for (NodeResult& one : ros2.nodes) {
    clean(one.name);
  }
  for (ExecutionResult& one : ros2.executions) {
    clean_all(one.node, one.service);
  }
  for (StartResult& one : results.starts) {
    clean_all(one.process, one.file);
  }
  if (results.startup) {
    for (StartStep& one : results.startup->critical_path) {
      clean_all(one.process, one.what);
    }
  }
  for (std::string& one : results.warnings) {
    clean(one);
  }
  return results;
}

}  // namespace tracing
