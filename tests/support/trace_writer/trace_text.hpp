// SPDX-License-Identifier: Apache-2.0
// Everything that a reader gives for a trace, as lines to compare.
#pragma once

#include <babeltrace2/babeltrace.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tracing/decode/reader/trace_reader.hpp"

namespace tracing::testing {

inline std::string text_of(const FieldValue& value) {
  std::string label;
  if (const auto known = value.enumeration_label()) {
    label = fmt::format("'{}' ", *known);
  }
  if (const auto number = value.unsigned_integer()) {
    return fmt::format("{}u{}", label, *number);
  }
  if (const auto number = value.integer()) {
    return fmt::format("{}i{}", label, *number);
  }
  if (const auto number = value.real()) {
    return fmt::format("r{}", *number);
  }
  if (const auto string = value.string()) {
    return fmt::format("\"{}\"", *string);
  }
  std::string text = value.is_array() ? "[" : value.is_structure() ? "{" : value.is_variant() ? "<" : "?";
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (value.is_structure()) {
      text += fmt::format("{}=", value.member_name(i));
    }
    text += text_of(value[i]) + " ";
  }
  return text;
}

// One line for each event or loss, in the order of time. Lines of the same time are in alphabetical order.
inline std::vector<std::string> trace_text(const std::filesystem::path& directory, TraceReader::Decoder decoder) {
  class Sink : public TraceSink {
   public:
    std::vector<std::pair<std::int64_t, std::string>> lines;
    void on_event(const Event& event) override {
      std::string line = fmt::format("{} {} cpu={} vpid={} vtid={} procname={}", event.timestamp_ns, event.name(),
                                     event.cpu_id.value_or(-1), event.vpid.value_or(-1), event.vtid.value_or(-1),
                                     event.procname.value_or("-"));
      for (std::size_t i = 0; i < event.event_class->fields.size(); ++i) {
        line += fmt::format(" {}={}", event.event_class->fields[i], text_of(event.field(i)));
      }
      for (std::size_t i = 0; i < event.event_class->contexts.size(); ++i) {
        line += fmt::format(" context {}={}", event.event_class->contexts[i], text_of(event.context(i)));
      }
      lines.emplace_back(event.timestamp_ns, std::move(line));
    }
    void on_loss(const Loss& loss) override {
      const auto number = [](const auto& value) { return value ? std::to_string(*value) : std::string("unknown"); };
      lines.emplace_back(
          loss.begin_ns.value_or(0),
          fmt::format("loss of {} {} from {} to {} in {}", number(loss.count),
                      loss.kind == Loss::Kind::kEvents ? "events" : "packets", number(loss.begin_ns),
                      number(loss.end_ns), std::filesystem::path(loss.stream->name).filename().string()));
    }
  };
  Sink sink;
  TraceReader(directory, decoder).read(sink);
  std::stable_sort(sink.lines.begin(), sink.lines.end());
  std::vector<std::string> lines;
  for (auto& line : sink.lines) {
    lines.push_back(std::move(line.second));
  }
  return lines;
}

// The lines of our own decoder that libbabeltrace2 must give, too. If the first packet of a stream says that events
// have been lost, nobody knows how many of them belong to the trace. Our decoder tells it, and so does
// libbabeltrace2 2.0, but no later version.
inline std::vector<std::string> lines_of_babeltrace(std::vector<std::string> lines) {
  if (bt_version_get_major() > 2 || bt_version_get_minor() > 0) {
    std::erase_if(lines, [](const std::string& line) { return line.starts_with("loss of unknown events"); });
  }
  return lines;
}

}  // namespace tracing::testing
