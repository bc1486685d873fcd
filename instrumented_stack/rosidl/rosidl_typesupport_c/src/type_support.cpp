// SPDX-License-Identifier: Apache-2.0
#include "rosidl_typesupport_c/type_support.hpp"

#include <algorithm>
#include <cstring>
#include <iterator>

#include "rosidl_typesupport_c/element.hpp"
#include "rosidl_typesupport_c/identifier.h"
#include "rosidl_typesupport_fastrtps_cpp/identifier.hpp"

const char* const rosidl_typesupport_c__typesupport_identifier = "rosidl_typesupport_c";

namespace rosidl_typesupport_c {
namespace {

bool is_of_c(const char* identifier) {
  return std::strcmp(identifier, kIdentifier) == 0 ||
         std::strcmp(identifier, rosidl_typesupport_c__typesupport_identifier) == 0;
}

// Puts a copy of the message, if there is one, into the sequence at field `index` of the event.
bool add(const Layout& event, std::size_t index, const void* message, void* target) {
  if (message == nullptr) {
    return true;
  }
  const Field field = field_of(event, index);
  void* sequence = member(target, field.offset);
  return resize(field.element, sequence, 1) && copy(field.element, message, load(sequence).data, 1);
}

void set_info(const Layout& layout, const rosidl_service_introspection_info_t& info, void* target) {
  // The fields of service_msgs/msg/ServiceEventInfo: event_type, stamp, client_gid, sequence_number.
  const auto put = [](void* message, std::size_t offset, const auto& value) {
    std::memcpy(member(message, offset), &value, sizeof value);
  };
  const Layout& time = *layout.nested[1];
  void* stamp = member(target, layout.offsets[1]);
  put(target, layout.offsets[0], info.event_type);
  put(stamp, time.offsets[0], info.stamp_sec);
  put(stamp, time.offsets[1], info.stamp_nanosec);
  put(target, layout.offsets[2], info.client_gid);
  put(target, layout.offsets[3], info.sequence_number);
}

ToPython python_conversion = nullptr;

}  // namespace

void set_to_python(ToPython function) {
  python_conversion = function;
}

void* to_python(const Layout& layout, void* message) {
  return python_conversion(layout, message);
}

const char* const kIdentifier = rosidl_typesupport_fastrtps_cpp::typesupport_identifier_of_c;

const rosidl_message_type_support_t* itself(const rosidl_message_type_support_t* handle, const char* identifier) {
  return is_of_c(identifier) ? handle : nullptr;
}

const rosidl_service_type_support_t* itself(const rosidl_service_type_support_t* handle, const char* identifier) {
  return is_of_c(identifier) ? handle : nullptr;
}

void* create_event(const Layout& layout, const rosidl_service_introspection_info_t& info, const void* request,
                   const void* response) {
  void* event = rosidl_typesupport_c__message_create(&layout);
  if (event == nullptr) {
    return nullptr;
  }
  set_info(*layout.nested[0], info, member(event, layout.offsets[0]));
  if (!add(layout, 1, request, event) || !add(layout, 2, response, event)) {
    rosidl_typesupport_c__message_destroy(&layout, event);
    return nullptr;
  }
  return event;
}

}  // namespace rosidl_typesupport_c
