// SPDX-License-Identifier: Apache-2.0
// The way from the installed classes to those of trace_reader behind them. Private to the library.
#pragma once

#include <cstdint>
#include <cstring>
#include <new>
#include <type_traits>
#include <vector>

#include "launch_trace/reader.hpp"
#include "tracing/decode/reader/event.hpp"
#include "tracing/decode/reader/struct_fields.hpp"

namespace launch_trace {

// An event class, and how its events are read as the struct that stands for them.
struct KnownClass : EventClass {
  const void* view = nullptr;                    // the address of view_of<Struct>; null: there is no struct
  std::vector<tracing::FieldPlace> view_places;  // for tracing::read_fields()
};

template <class Struct>
inline constexpr char view_of = 0;

// Finds the struct for the class of this event, if there is one, and how to read it.
void set_view(KnownClass& known, const tracing::Event& event);

struct Access {
  // A Value holds a FieldValue in its bytes.
  static Value value(const tracing::FieldValue& field) {
    static_assert(sizeof(tracing::FieldValue) == sizeof(Value::data_));
    static_assert(alignof(tracing::FieldValue) <= alignof(Value));
    static_assert(std::is_trivially_copyable_v<tracing::FieldValue>);
    Value value;
    std::memcpy(value.data_.data(), &field, sizeof field);
    return value;
  }
  static const tracing::FieldValue& field(const Value& value) {
    return *std::launder(reinterpret_cast<const tracing::FieldValue*>(value.data_.data()));
  }
  static const tracing::Event& event(const Event& event) { return *static_cast<const tracing::Event*>(event.event_); }
  static const KnownClass& known(const Event& event) { return static_cast<const KnownClass&>(*event.class_); }

  static void set(Event& event, const KnownClass& known, const tracing::Event& recorded) {
    event.class_ = &known;
    event.time_ns_ = recorded.timestamp_ns;
    event.event_ = &recorded;
  }
  static void set(Item& item, const Event* event, const Loss* loss) {
    item.event_ = event;
    item.loss_ = loss;
  }
};

}  // namespace launch_trace
