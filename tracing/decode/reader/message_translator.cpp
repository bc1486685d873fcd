// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/reader/message_translator.hpp"

#include <fmt/format.h>

#include "tracing/decode/reader/trace_read_error.hpp"

namespace tracing {

namespace {

std::optional<std::size_t> member_index(const bt_field_class* structure, const char* name) {
  if (structure == nullptr) {
    return std::nullopt;
  }
  for (std::uint64_t i = 0; i < bt_field_class_structure_get_member_count(structure); ++i) {
    const auto* member = bt_field_class_structure_borrow_member_by_index_const(structure, i);
    if (bt_field_class_structure_member_get_name(member) == std::string_view(name)) {
      return i;
    }
  }
  return std::nullopt;
}

void add_names(const bt_field_class* structure, std::vector<std::string>& names) {
  if (structure == nullptr) {
    return;
  }
  for (std::uint64_t i = 0; i < bt_field_class_structure_get_member_count(structure); ++i) {
    names.emplace_back(
        bt_field_class_structure_member_get_name(bt_field_class_structure_borrow_member_by_index_const(structure, i)));
  }
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

std::string environment_text(const bt_trace* trace, const char* name) {
  const bt_value* value = bt_trace_borrow_environment_entry_value_by_name_const(trace, name);
  return value != nullptr && bt_value_is_string(value) ? bt_value_string_get(value) : "";
}

std::string uuid_text(const std::uint8_t* uuid) {
  std::string text;
  for (std::size_t i = 0; uuid != nullptr && i < 16; ++i) {
    text += fmt::format("{}{:02x}", i == 4 || i == 6 || i == 8 || i == 10 ? "-" : "", uuid[i]);
  }
  return text;
}

Recording recording_of_stream(const bt_stream* stream) {
  const bt_trace* trace = bt_stream_borrow_trace_const(stream);
  const bt_clock_class* clock = bt_stream_class_borrow_default_clock_class_const(bt_stream_borrow_class_const(stream));
  return recording_of({.hostname = environment_text(trace, "hostname"),
                       .domain = environment_text(trace, "domain"),
                       .trace_name = environment_text(trace, "trace_name"),
                       .trace_creation_datetime = environment_text(trace, "trace_creation_datetime"),
                       .clock_uuid = clock == nullptr ? std::string() : uuid_text(bt_clock_class_get_uuid(clock)),
                       .trace_uuid = uuid_text(bt_trace_get_uuid(trace))});
}

}  // namespace

struct MessageTranslator::KnownClass {
  EventClass description;
  Recording recording;
  std::optional<std::size_t> cpu_id;  // index in the packet context
  std::optional<std::size_t> vpid;    // the next ones are indices in the common event context
  std::optional<std::size_t> vtid;
  std::optional<std::size_t> procname;
  babeltrace::EventClassReference reference;  // keeps the key's address from being reused
};

std::optional<std::int64_t> time_of_inactivity(const bt_message* message) {
  return bt_message_get_type(message) == BT_MESSAGE_TYPE_MESSAGE_ITERATOR_INACTIVITY
             ? time_of(bt_message_message_iterator_inactivity_borrow_clock_snapshot_const(message))
             : std::nullopt;
}

MessageTranslator::MessageTranslator() = default;
MessageTranslator::~MessageTranslator() = default;

TraceItem MessageTranslator::translate(const bt_message* message) {
  switch (bt_message_get_type(message)) {
    case BT_MESSAGE_TYPE_EVENT:
      return translate_event(message);
    case BT_MESSAGE_TYPE_DISCARDED_EVENTS:
      return translate_loss(message, Loss::Kind::kEvents);
    case BT_MESSAGE_TYPE_DISCARDED_PACKETS:
      return translate_loss(message, Loss::Kind::kPackets);
    default:
      return {};
  }
}

TraceItem MessageTranslator::translate_event(const bt_message* message) {
  const bt_event* recorded = bt_message_event_borrow_event_const(message);
  const KnownClass& known = known_class(recorded);

  event_ = Event();
  event_.event_class = &known.description;
  event_.timestamp_ns = time_of(bt_message_event_borrow_default_clock_snapshot_const(message)).value_or(0);
  if (known.cpu_id) {
    const bt_field* context = bt_packet_borrow_context_field_const(bt_event_borrow_packet_const(recorded));
    event_.cpu_id = member(context, *known.cpu_id).integer();
  }
  const bt_field* const context = bt_event_borrow_common_context_field_const(recorded);
  if (known.vpid) {
    event_.vpid = member(context, *known.vpid).integer();
  }
  if (known.vtid) {
    event_.vtid = member(context, *known.vtid).integer();
  }
  if (known.procname) {
    event_.procname = member(context, *known.procname).string();
  }
  event_.foreign_payload = bt_event_borrow_payload_field_const(recorded);
  event_.foreign_stream_context = context;
  event_.foreign_event_context = bt_event_borrow_specific_context_field_const(recorded);
  return {&event_, nullptr};
}

TraceItem MessageTranslator::translate_loss(const bt_message* message, Loss::Kind kind) {
  loss_ = Loss();
  loss_.kind = kind;
  std::uint64_t count = 0;
  const bool of_events = kind == Loss::Kind::kEvents;
  const bt_stream* stream = of_events ? bt_message_discarded_events_borrow_stream_const(message)
                                      : bt_message_discarded_packets_borrow_stream_const(message);
  const bt_stream_class* stream_class = bt_stream_borrow_class_const(stream);
  loss_.stream = &known_stream(stream);
  if (of_events) {
    if (bt_message_discarded_events_get_count(message, &count) == BT_PROPERTY_AVAILABILITY_AVAILABLE) {
      loss_.count = count;
    }
    if (bt_stream_class_discarded_events_have_default_clock_snapshots(stream_class)) {
      loss_.begin_ns = time_of(bt_message_discarded_events_borrow_beginning_default_clock_snapshot_const(message));
      loss_.end_ns = time_of(bt_message_discarded_events_borrow_end_default_clock_snapshot_const(message));
    }
  } else {
    if (bt_message_discarded_packets_get_count(message, &count) == BT_PROPERTY_AVAILABILITY_AVAILABLE) {
      loss_.count = count;
    }
    if (bt_stream_class_discarded_packets_have_default_clock_snapshots(stream_class)) {
      loss_.begin_ns = time_of(bt_message_discarded_packets_borrow_beginning_default_clock_snapshot_const(message));
      loss_.end_ns = time_of(bt_message_discarded_packets_borrow_end_default_clock_snapshot_const(message));
    }
  }
  return {nullptr, &loss_};
}

const MessageTranslator::KnownClass& MessageTranslator::known_class(const bt_event* event) {
  const bt_event_class* event_class = bt_event_borrow_class_const(event);
  std::unique_ptr<KnownClass>& slot = classes_[event_class];
  if (slot) {
    return *slot;
  }

  auto known = std::make_unique<KnownClass>();
  bt_event_class_get_ref(event_class);
  known->reference.reset(event_class);
  const char* name = bt_event_class_get_name(event_class);
  known->description.name = name == nullptr ? "" : name;
  known->description.id = classes_.size() - 1;
  const bt_stream* stream = bt_event_borrow_stream_const(event);
  known->description.trace = known_stream(stream).trace;
  known->description.recording = &known->recording;
  known->recording = recording_of_stream(stream);
  add_names(bt_event_class_borrow_payload_field_class_const(event_class), known->description.fields);

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
  add_names(context, known->description.contexts);
  known->description.stream_contexts = known->description.contexts.size();
  add_names(bt_event_class_borrow_specific_context_field_class_const(event_class), known->description.contexts);
  slot = std::move(known);
  return *slot;
}

const Stream& MessageTranslator::known_stream(const bt_stream* stream) {
  const Stream*& slot = stream_index_[stream];
  if (slot != nullptr) {
    return *slot;
  }

  const bt_trace* trace = bt_stream_borrow_trace_const(stream);
  Stream description;
  if (const char* name = bt_stream_get_name(stream)) {
    description.name = name;
  }
  description.trace = known_trace(trace);
  TraceDescription& of = traces_[description.trace];
  if (of.directories.empty()) {
    of.directories.push_back(std::filesystem::path(description.name).parent_path());
  }
  const bt_value* vpid = bt_trace_borrow_environment_entry_value_by_name_const(trace, "vpid");
  if (vpid != nullptr && bt_value_is_signed_integer(vpid)) {
    description.vpid = bt_value_integer_signed_get(vpid);
  }
  bt_stream_get_ref(stream);
  stream_references_.emplace_back(stream);
  slot = &streams_.emplace_back(std::move(description));
  return *slot;
}

std::size_t MessageTranslator::known_trace(const bt_trace* trace) {
  const auto [known, is_new] = trace_index_.try_emplace(trace, traces_.size());
  if (!is_new) {
    return known->second;
  }
  TraceDescription& description = traces_.emplace_back();
  description.uuid = uuid_text(bt_trace_get_uuid(trace));
  for (std::uint64_t i = 0; i < bt_trace_get_environment_entry_count(trace); ++i) {
    const char* name = nullptr;
    const bt_value* value = nullptr;
    bt_trace_borrow_environment_entry_by_index_const(trace, i, &name, &value);
    if (bt_value_is_signed_integer(value)) {
      description.environment[name] = bt_value_integer_signed_get(value);
    } else if (bt_value_is_string(value)) {
      description.environment[name] = bt_value_string_get(value);
    }
  }
  return known->second;
}

}  // namespace tracing
