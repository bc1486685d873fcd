// SPDX-License-Identifier: Apache-2.0
#include "tracing/reader/message_translator.hpp"

#include <fmt/format.h>

#include "tracing/reader/trace_read_error.hpp"

namespace tracing {

namespace {

std::optional<std::size_t> member_index(const bt_field_class* structure, const char* name) {
  if (structure == nullptr) return std::nullopt;
  for (std::uint64_t i = 0; i < bt_field_class_structure_get_member_count(structure); ++i) {
    const auto* member = bt_field_class_structure_borrow_member_by_index_const(structure, i);
    if (bt_field_class_structure_member_get_name(member) == std::string_view(name)) return i;
  }
  return std::nullopt;
}

FieldValue member(const bt_field* structure, std::size_t index) {
  return FieldValue(bt_field_structure_borrow_member_field_by_index_const(structure, index));
}

std::optional<std::int64_t> time_of(const bt_clock_snapshot* snapshot) {
  std::int64_t time = 0;
  if (bt_clock_snapshot_get_ns_from_origin(snapshot, &time) != BT_CLOCK_SNAPSHOT_GET_NS_FROM_ORIGIN_STATUS_OK) {
    bt_current_thread_clear_error();
    return std::nullopt;
  }
  return time;
}

}  // namespace

struct MessageTranslator::KnownClass {
  EventClass description;
  std::optional<std::size_t> cpu_id;  // index in the packet context
  std::optional<std::size_t> vpid;    // the next ones are indices in the common event context
  std::optional<std::size_t> vtid;
  std::optional<std::size_t> procname;
  bool has_context = false;
  babeltrace::EventClassReference reference;  // keeps the key's address from being reused
};

MessageTranslator::MessageTranslator() = default;
MessageTranslator::~MessageTranslator() = default;

void MessageTranslator::translate(const bt_message* message, TraceSink& sink) {
  switch (bt_message_get_type(message)) {
    case BT_MESSAGE_TYPE_EVENT:
      return translate_event(message, sink);
    case BT_MESSAGE_TYPE_DISCARDED_EVENTS:
      return translate_loss(message, Loss::Kind::kEvents, sink);
    case BT_MESSAGE_TYPE_DISCARDED_PACKETS:
      return translate_loss(message, Loss::Kind::kPackets, sink);
    default:
      return;
  }
}

void MessageTranslator::translate_event(const bt_message* message, TraceSink& sink) {
  const bt_event* recorded = bt_message_event_borrow_event_const(message);
  const KnownClass& known = known_class(recorded);

  Event event;
  event.event_class = &known.description;
  event.timestamp_ns = time_of(bt_message_event_borrow_default_clock_snapshot_const(message)).value_or(0);
  if (known.cpu_id) {
    const bt_field* context = bt_packet_borrow_context_field_const(bt_event_borrow_packet_const(recorded));
    event.cpu_id = member(context, *known.cpu_id).integer();
  }
  if (known.has_context) {
    const bt_field* context = bt_event_borrow_common_context_field_const(recorded);
    if (known.vpid) event.vpid = member(context, *known.vpid).integer();
    if (known.vtid) event.vtid = member(context, *known.vtid).integer();
    if (known.procname) event.procname = member(context, *known.procname).string();
  }
  event.foreign_payload = bt_event_borrow_payload_field_const(recorded);
  sink.on_event(event);
}

void MessageTranslator::translate_loss(const bt_message* message, Loss::Kind kind, TraceSink& sink) {
  Loss loss;
  loss.kind = kind;
  std::uint64_t count = 0;
  const bool of_events = kind == Loss::Kind::kEvents;
  const bt_stream* stream = of_events ? bt_message_discarded_events_borrow_stream_const(message)
                                      : bt_message_discarded_packets_borrow_stream_const(message);
  const bt_stream_class* stream_class = bt_stream_borrow_class_const(stream);
  loss.stream = &known_stream(stream);
  if (of_events) {
    if (bt_message_discarded_events_get_count(message, &count) == BT_PROPERTY_AVAILABILITY_AVAILABLE) {
      loss.count = count;
    }
    if (bt_stream_class_discarded_events_have_default_clock_snapshots(stream_class)) {
      loss.begin_ns = time_of(bt_message_discarded_events_borrow_beginning_default_clock_snapshot_const(message));
      loss.end_ns = time_of(bt_message_discarded_events_borrow_end_default_clock_snapshot_const(message));
    }
  } else {
    if (bt_message_discarded_packets_get_count(message, &count) == BT_PROPERTY_AVAILABILITY_AVAILABLE) {
      loss.count = count;
    }
    if (bt_stream_class_discarded_packets_have_default_clock_snapshots(stream_class)) {
      loss.begin_ns = time_of(bt_message_discarded_packets_borrow_beginning_default_clock_snapshot_const(message));
      loss.end_ns = time_of(bt_message_discarded_packets_borrow_end_default_clock_snapshot_const(message));
    }
  }
  sink.on_loss(loss);
}

const MessageTranslator::KnownClass& MessageTranslator::known_class(const bt_event* event) {
  const bt_event_class* event_class = bt_event_borrow_class_const(event);
  std::unique_ptr<KnownClass>& slot = classes_[event_class];
  if (slot) return *slot;

  auto known = std::make_unique<KnownClass>();
  bt_event_class_get_ref(event_class);
  known->reference.reset(event_class);
  const char* name = bt_event_class_get_name(event_class);
  known->description.name = name == nullptr ? "" : name;
  known->description.id = classes_.size() - 1;
  known->description.trace = known_stream(bt_event_borrow_stream_const(event)).trace;
  if (const bt_field_class* payload = bt_event_class_borrow_payload_field_class_const(event_class)) {
    for (std::uint64_t i = 0; i < bt_field_class_structure_get_member_count(payload); ++i) {
      const auto* field = bt_field_class_structure_borrow_member_by_index_const(payload, i);
      known->description.fields.emplace_back(bt_field_class_structure_member_get_name(field));
    }
  }

  const bt_stream_class* stream_class = bt_event_class_borrow_stream_class_const(event_class);
  if (bt_stream_class_borrow_default_clock_class_const(stream_class) == nullptr) {
    throw TraceReadError(fmt::format("the events '{}' of a trace have no time", known->description.name),
                         "only traces with a clock, such as LTTng's, can be read");
  }
  if (bt_stream_class_supports_packets(stream_class)) {
    known->cpu_id = member_index(bt_stream_class_borrow_packet_context_field_class_const(stream_class), "cpu_id");
  }
  const bt_field_class* context = bt_stream_class_borrow_event_common_context_field_class_const(stream_class);
  known->vpid = member_index(context, "vpid");
  known->vtid = member_index(context, "vtid");
  known->procname = member_index(context, "procname");
  known->has_context = known->vpid || known->vtid || known->procname;
  slot = std::move(known);
  return *slot;
}

const Stream& MessageTranslator::known_stream(const bt_stream* stream) {
  const Stream*& slot = stream_index_[stream];
  if (slot != nullptr) return *slot;

  const bt_trace* trace = bt_stream_borrow_trace_const(stream);
  Stream description;
  if (const char* name = bt_stream_get_name(stream)) description.name = name;
  description.trace = known_trace(trace);
  const bt_value* vpid = bt_trace_borrow_environment_entry_value_by_name_const(trace, "vpid");
  if (vpid != nullptr && bt_value_is_signed_integer(vpid)) description.vpid = bt_value_integer_signed_get(vpid);
  bt_stream_get_ref(stream);
  stream_references_.emplace_back(stream);
  slot = &streams_.emplace_back(std::move(description));
  return *slot;
}

std::size_t MessageTranslator::known_trace(const bt_trace* trace) {
  return traces_.try_emplace(trace, traces_.size()).first->second;
}

}  // namespace tracing
