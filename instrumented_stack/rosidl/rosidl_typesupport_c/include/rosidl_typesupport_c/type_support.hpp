// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "rosidl_runtime_c/action_type_support_struct.h"
#include "rosidl_runtime_c/message_type_support_struct.h"
#include "rosidl_runtime_c/service_type_support_struct.h"
#include "rosidl_typesupport_c/message_layout.h"
#include "rosidl_typesupport_c/python.hpp"
#include "rosidl_typesupport_fastrtps_cpp/message_type_support.h"
#include "rosidl_typesupport_fastrtps_cpp/service_type_support.h"
#include "rosidl_typesupport_interface/macros.h"

// Creates the handles of C messages from their layouts, and defines their functions. Only the generated source files
// include this header.
namespace rosidl_typesupport_c {

// The bytes of a message. `read` and `write` return false where the callbacks of type supports do.
bool write(const Layout& layout, const void* message, eprosima::fastcdr::Cdr& cdr);
bool read(const Layout& layout, eprosima::fastcdr::Cdr& cdr, void* message);
std::uint32_t serialized_size(const Layout& layout, const void* message);
std::size_t max_serialized_size(const Layout& layout, char& bounds_info);

// The handle if `identifier` is one of C.
const rosidl_message_type_support_t* itself(const rosidl_message_type_support_t* handle, const char* identifier);
const rosidl_service_type_support_t* itself(const rosidl_service_type_support_t* handle, const char* identifier);

// An event message of a service, whose layout is that of its <service>_Event. Null if memory runs out.
void* create_event(const Layout& layout, const rosidl_service_introspection_info_t& info, const void* request,
                   const void* response);

// The callbacks of a type support have no argument that tells the type, so each type has its own.
template <const Layout& L>
struct Callbacks {
  static bool write(const void* message, eprosima::fastcdr::Cdr& cdr) {
    return rosidl_typesupport_c::write(L, message, cdr);
  }
  static bool read(eprosima::fastcdr::Cdr& cdr, void* message) { return rosidl_typesupport_c::read(L, cdr, message); }
  static std::uint32_t size(const void* message) { return serialized_size(L, message); }
  static std::size_t max_size(char& bounds_info) { return max_serialized_size(L, bounds_info); }
  static void* create() { return rosidl_typesupport_c__message_create(&L); }
  static void destroy(void* message) { rosidl_typesupport_c__message_destroy(&L, message); }
  static void* to_python(void* message) { return rosidl_typesupport_c::to_python(L, message); }
  static void* create_event(const rosidl_service_introspection_info_t* info, const void* request,
                            const void* response) {
    return rosidl_typesupport_c::create_event(L, *info, request, response);
  }
};

extern const char* const kIdentifier;

template <const Layout& L>
const rosidl_message_type_support_t* message_type_support(const char* message_namespace, const char* message_name) {
  using Functions = Callbacks<L>;
  static const MessageSupport support{
      {message_namespace, message_name, L.description->type_hash, Functions::write, Functions::read, Functions::size,
       Functions::max_size, L.description, Functions::create, Functions::destroy},
      &L,
      Functions::to_python};
  static const rosidl_message_type_support_t handle{kIdentifier, &support, itself};
  return &handle;
}

template <const Layout& Event>
const rosidl_service_type_support_t* service_type_support(const char* service_namespace, const char* service_name,
                                                          const rosidl_message_type_support_t* request,
                                                          const rosidl_message_type_support_t* response,
                                                          const rosidl_message_type_support_t* event,
                                                          const rosidl_type_description_t& description) {
  static const service_type_support_callbacks_t callbacks{service_namespace, service_name, request, response,
                                                          &description};
  static const rosidl_service_type_support_t handle{kIdentifier,
                                                    &callbacks,
                                                    itself,
                                                    request,
                                                    response,
                                                    event,
                                                    Callbacks<Event>::create_event,
                                                    Callbacks<Event>::destroy};
  return &handle;
}

}  // namespace rosidl_typesupport_c

// Defines the functions of C message MESSAGE, for example std_msgs__msg__String, and its type support. Its layout
// MESSAGE__layout stands before.
#define ROSIDL_TYPESUPPORT_C__DEFINE_MESSAGE(MESSAGE, PACKAGE, NAMESPACE, NAME)                                \
  bool MESSAGE##__init(MESSAGE* msg) {                                                                         \
    return rosidl_typesupport_c__message_init(&MESSAGE##__layout, msg);                                        \
  }                                                                                                            \
  void MESSAGE##__fini(MESSAGE* msg) {                                                                         \
    rosidl_typesupport_c__message_fini(&MESSAGE##__layout, msg);                                               \
  }                                                                                                            \
  MESSAGE* MESSAGE##__create(void) {                                                                           \
    return static_cast<MESSAGE*>(rosidl_typesupport_c__message_create(&MESSAGE##__layout));                    \
  }                                                                                                            \
  void MESSAGE##__destroy(MESSAGE* msg) {                                                                      \
    rosidl_typesupport_c__message_destroy(&MESSAGE##__layout, msg);                                            \
  }                                                                                                            \
  bool MESSAGE##__are_equal(const MESSAGE* lhs, const MESSAGE* rhs) {                                          \
    return rosidl_typesupport_c__message_are_equal(&MESSAGE##__layout, lhs, rhs);                              \
  }                                                                                                            \
  bool MESSAGE##__copy(const MESSAGE* input, MESSAGE* output) {                                                \
    return rosidl_typesupport_c__message_copy(&MESSAGE##__layout, input, output);                              \
  }                                                                                                            \
  bool MESSAGE##__Sequence__init(MESSAGE##__Sequence* array, size_t size) {                                    \
    return rosidl_typesupport_c__sequence_init(&MESSAGE##__layout, array, size);                               \
  }                                                                                                            \
  void MESSAGE##__Sequence__fini(MESSAGE##__Sequence* array) {                                                 \
    rosidl_typesupport_c__sequence_fini(&MESSAGE##__layout, array);                                            \
  }                                                                                                            \
  MESSAGE##__Sequence* MESSAGE##__Sequence__create(size_t size) {                                              \
    return static_cast<MESSAGE##__Sequence*>(rosidl_typesupport_c__sequence_create(&MESSAGE##__layout, size)); \
  }                                                                                                            \
  void MESSAGE##__Sequence__destroy(MESSAGE##__Sequence* array) {                                              \
    rosidl_typesupport_c__sequence_destroy(&MESSAGE##__layout, array);                                         \
  }                                                                                                            \
  bool MESSAGE##__Sequence__are_equal(const MESSAGE##__Sequence* lhs, const MESSAGE##__Sequence* rhs) {        \
    return rosidl_typesupport_c__sequence_are_equal(&MESSAGE##__layout, lhs, rhs);                             \
  }                                                                                                            \
  bool MESSAGE##__Sequence__copy(const MESSAGE##__Sequence* input, MESSAGE##__Sequence* output) {              \
    return rosidl_typesupport_c__sequence_copy(&MESSAGE##__layout, input, output);                             \
  }                                                                                                            \
  const rosidl_message_type_support_t* ROSIDL_TYPESUPPORT_INTERFACE__MESSAGE_SYMBOL_NAME(                      \
      rosidl_typesupport_c, PACKAGE, NAMESPACE, NAME)(void) {                                                  \
    return rosidl_typesupport_c::message_type_support<MESSAGE##__layout>(#PACKAGE "::" #NAMESPACE, #NAME);     \
  }

// Defines the type support of service SERVICE. Those of its messages stand before.
#define ROSIDL_TYPESUPPORT_C__DEFINE_SERVICE(SERVICE, PACKAGE, NAMESPACE, NAME)                                        \
  const rosidl_service_type_support_t* ROSIDL_TYPESUPPORT_INTERFACE__SERVICE_SYMBOL_NAME(                              \
      rosidl_typesupport_c, PACKAGE, NAMESPACE, NAME)(void) {                                                          \
    return rosidl_typesupport_c::service_type_support<SERVICE##_Event__layout>(                                        \
        #PACKAGE "::" #NAMESPACE, #NAME,                                                                               \
        ROSIDL_TYPESUPPORT_INTERFACE__MESSAGE_SYMBOL_NAME(rosidl_typesupport_c, PACKAGE, NAMESPACE, NAME##_Request)(), \
        ROSIDL_TYPESUPPORT_INTERFACE__MESSAGE_SYMBOL_NAME(rosidl_typesupport_c, PACKAGE, NAMESPACE,                    \
                                                          NAME##_Response)(),                                          \
        ROSIDL_TYPESUPPORT_INTERFACE__MESSAGE_SYMBOL_NAME(rosidl_typesupport_c, PACKAGE, NAMESPACE, NAME##_Event)(),   \
        SERVICE##__type_description);                                                                                  \
  }

// Defines the type support of action ACTION. Those of its services and messages stand before.
#define ROSIDL_TYPESUPPORT_C__DEFINE_ACTION(ACTION, PACKAGE, NAME)                                                    \
  const rosidl_action_type_support_t* ROSIDL_TYPESUPPORT_INTERFACE__ACTION_SYMBOL_NAME(rosidl_typesupport_c, PACKAGE, \
                                                                                       action, NAME)(void) {          \
    static const rosidl_action_type_support_t handle{                                                                 \
        ROSIDL_TYPESUPPORT_INTERFACE__SERVICE_SYMBOL_NAME(rosidl_typesupport_c, PACKAGE, action, NAME##_SendGoal)(),  \
        ROSIDL_TYPESUPPORT_INTERFACE__SERVICE_SYMBOL_NAME(rosidl_typesupport_c, PACKAGE, action, NAME##_GetResult)(), \
        rosidl_typesupport_c__get_service_type_support_handle__action_msgs__srv__CancelGoal(),                        \
        ROSIDL_TYPESUPPORT_INTERFACE__MESSAGE_SYMBOL_NAME(rosidl_typesupport_c, PACKAGE, action,                      \
                                                          NAME##_FeedbackMessage)(),                                  \
        rosidl_typesupport_c__get_message_type_support_handle__action_msgs__msg__GoalStatusArray(),                   \
        &ACTION##__type_description};                                                                                 \
    return &handle;                                                                                                   \
  }
