// SPDX-License-Identifier: Apache-2.0
// Turns libbabeltrace2's messages into events and losses. Private to the reader.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <unordered_map>

#include "tracing/decode/reader/babeltrace.hpp"
#include "tracing/decode/reader/event.hpp"

namespace tracing {

// Until when nothing happens, if the message says so.
std::optional<std::int64_t> time_of_inactivity(const bt_message* message);

// Looks up the metadata of an event class once, at its first event. After that an event takes one look-up by address
// and no allocation.
class MessageTranslator {
 public:
  MessageTranslator();
  ~MessageTranslator();

  // Nothing for other messages. An item is valid until the next call, and as long as its message.
  TraceItem translate(const bt_message* message);

  // Those that have given a message, in this order.
  const std::deque<TraceDescription>& traces() const { return traces_; }

 private:
  struct KnownClass;

  TraceItem translate_event(const bt_message* message);
  TraceItem translate_loss(const bt_message* message, Loss::Kind kind);
  const KnownClass& known_class(const bt_event* event);
  const Stream& known_stream(const bt_stream* stream);
  std::size_t known_trace(const bt_trace* trace);

  std::unordered_map<const bt_event_class*, std::unique_ptr<KnownClass>> classes_;
  std::deque<Stream> streams_;
  std::unordered_map<const bt_stream*, const Stream*> stream_index_;
  std::deque<TraceDescription> traces_;
  std::unordered_map<const bt_trace*, std::size_t> trace_index_;
  std::deque<babeltrace::StreamReference> stream_references_;  // keeps the addresses above from being reused
  Event event_;
  Loss loss_;
};

}  // namespace tracing
