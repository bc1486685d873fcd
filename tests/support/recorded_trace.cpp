// SPDX-License-Identifier: Apache-2.0
#include "tests/support/recorded_trace.hpp"

#include <gtest/gtest.h>

#include "tracing/decode/reader/trace_reader.hpp"

namespace test_support {

namespace {

class Recorder : public tracing::TraceSink {
 public:
  void on_event(const tracing::Event& event) override {
    RecordedEvent recorded;
    recorded.name = event.name();
    recorded.timestamp = event.timestamp_ns;
    recorded.vpid = event.vpid.value_or(0);
    recorded.vtid = event.vtid.value_or(0);
    recorded.cpu_id = event.cpu_id.value_or(0);
    recorded.procname = event.procname.value_or("");
    for (std::size_t i = 0; i < event.event_class->fields.size(); ++i) {
      const std::string& name = event.event_class->fields[i];
      const tracing::FieldValue value = event.field(i);
      if (value.is_array()) {
        for (std::size_t k = 0; k < value.size(); ++k) {
          recorded.arrays[name].push_back(value[k].unsigned_integer().value_or(0));
        }
      } else if (const auto text = value.string()) {
        recorded.texts.emplace(name, *text);
      } else if (const auto number = value.unsigned_integer()) {
        recorded.numbers.emplace(name, *number);
      } else if (const auto integer = value.integer()) {
        recorded.numbers.emplace(name, static_cast<std::uint64_t>(*integer));
      }
    }
    trace.events.push_back(std::move(recorded));
  }
  void on_loss(const tracing::Loss&) override { ++trace.losses; }

  RecordedTrace trace;
};

}  // namespace

std::uint64_t RecordedEvent::number(const std::string& field) const {
  const auto found = numbers.find(field);
  EXPECT_NE(found, numbers.end()) << name << " has no number " << field;
  return found == numbers.end() ? 0 : found->second;
}

std::string RecordedEvent::text(const std::string& field) const {
  const auto found = texts.find(field);
  EXPECT_NE(found, texts.end()) << name << " has no text " << field;
  return found == texts.end() ? "" : found->second;
}

RecordedTrace read_trace(const std::filesystem::path& directory) {
  Recorder recorder;
  tracing::TraceReader(directory).read(recorder);
  return std::move(recorder.trace);
}

}  // namespace test_support
