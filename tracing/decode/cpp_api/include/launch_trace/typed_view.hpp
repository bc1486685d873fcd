// SPDX-License-Identifier: Apache-2.0
// Events of known providers as structs:
//
//   if (const auto start = launch_trace::as<launch_trace::ros2::CallbackStart>(event)) use(start->callback);
//
// The structs are those of launch_trace/typed_events.hpp, in the namespaces ros2, ros2_ext and launch.
#pragma once

#include <optional>

#include "launch_trace/event.hpp"
#include "launch_trace/typed_events.hpp"

namespace launch_trace {

// Returns false, and leaves `fields` alone, if this is another event. A field that the trace does not have, or has with
// another type, stays as it is. Defined for the structs of typed_events.hpp.
template <class Struct>
bool read(const Event& event, Struct& fields);

template <class Struct>
std::optional<Struct> as(const Event& event) {
  std::optional<Struct> fields(std::in_place);
  if (!read(event, *fields)) {
    fields.reset();
  }
  return fields;
}

}  // namespace launch_trace
