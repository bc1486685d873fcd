// SPDX-License-Identifier: Apache-2.0
// Keeps the events and losses of a reader, for assertions.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tracing/decode/reader/trace_reader.hpp"

namespace tracing::testing {

struct SeenEvent {
  std::string name;
  std::int64_t timestamp_ns;
  std::optional<std::int64_t> cpu_id;
  std::optional<std::int64_t> vpid;
  std::optional<std::int64_t> vtid;
  std::optional<std::string> procname;
  std::size_t trace;
};

struct SeenLoss {
  Loss::Kind kind;
  std::string stream;  // last part of the path
  std::optional<std::int64_t> vpid;
  std::optional<std::int64_t> begin_ns;
  std::optional<std::int64_t> end_ns;
  std::optional<std::uint64_t> count;
};

class RecordingSink : public TraceSink {
 public:
  std::vector<SeenEvent> events;
  std::vector<SeenLoss> losses;
  std::function<void(const Event&)> also;

  void on_event(const Event& event) override {
    std::optional<std::string> procname;
    if (event.procname) {
      procname.emplace(*event.procname);
    }
    events.push_back({std::string(event.name()), event.timestamp_ns, event.cpu_id, event.vpid, event.vtid, procname,
                      event.event_class->trace});
    if (also) {
      also(event);
    }
  }
  void on_loss(const Loss& loss) override {
    losses.push_back({loss.kind, std::filesystem::path(loss.stream->name).filename(), loss.stream->vpid, loss.begin_ns,
                      loss.end_ns, loss.count});
  }
};

}  // namespace tracing::testing
