// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/reader/recording.hpp"

#include <string_view>

namespace tracing {

namespace {

// The two sessions of a dual session are named alike, apart from their ends.
std::string_view without_half(std::string_view name) {
  for (const std::string_view half : {"-snapshot", "-runtime"}) {
    if (name.ends_with(half)) {
      return name.substr(0, name.size() - half.size());
    }
  }
  return name;
}

}  // namespace

Recording recording_of(const RecordingFacts& facts) {
  Recording recording{facts.hostname, facts.clock_uuid, facts.trace_uuid, facts.domain == "kernel"};
  if (facts.trace_name.empty()) {
    return recording;
  }
  const std::string_view name = without_half(facts.trace_name);
  recording.session = name;
  // The halves of a dual session begin at different times.
  if (name == facts.trace_name) {
    recording.session += " " + facts.trace_creation_datetime;
  }
  return recording;
}

}  // namespace tracing
