// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstring>
#include <iterator>
#include <memory>
#include <new>

#include "fastcdr_versions/cdr.hpp"
#include "rosidl_typesupport_cpp/message_type_support.hpp"
#include "rosidl_typesupport_fastrtps_cpp/cdr_members.hpp"
#include "rosidl_typesupport_fastrtps_cpp/identifier.hpp"
#include "rosidl_typesupport_fastrtps_cpp/message_type_support.h"
#include "rosidl_typesupport_fastrtps_cpp/service_type_support.h"

// Creates the handles of a package's types from their codecs. Only the generated source files include this header.
namespace rosidl_typesupport_fastrtps_cpp {

// The callbacks of type support. Here exceptions become return values.
template <typename Message>
struct Callbacks {
  static bool write(const void* message, eprosima::fastcdr::Cdr& cdr) {
    return fastcdr_versions::succeeds([&] { CdrCodec<Message>::write(cdr, *static_cast<const Message*>(message)); });
  }
  static bool read(eprosima::fastcdr::Cdr& cdr, void* message) {
    return fastcdr_versions::succeeds([&] { CdrCodec<Message>::read(cdr, *static_cast<Message*>(message)); });
  }
  static uint32_t size(const void* message) {
    return static_cast<uint32_t>(CdrCodec<Message>::end_after(*static_cast<const Message*>(message), 0));
  }
  static void* create() { return new Message; }
  static void destroy(void* message) { delete static_cast<Message*>(message); }
  static std::size_t max_size(char& bounds_info) {
    MaxSize size;
    CdrCodec<Message>::add_to(size);
    bounds_info = ROSIDL_TYPESUPPORT_FASTRTPS_UNBOUNDED_TYPE;
    if (size.bounded) {
      bounds_info = size.plain ? ROSIDL_TYPESUPPORT_FASTRTPS_PLAIN_TYPE : ROSIDL_TYPESUPPORT_FASTRTPS_BOUNDED_TYPE;
    }
    return size.end;
  }
};

// Such a handle provides only itself.
template <typename Handle>
const Handle* itself(const Handle* handle, const char* identifier) {
  return std::strcmp(identifier, typesupport_identifier) == 0 ? handle : nullptr;
}

template <typename Message>
const rosidl_message_type_support_t* message_type_support(const char* message_namespace, const char* message_name,
                                                          const rosidl_type_description_t& description) {
  using Functions = Callbacks<Message>;
  static const message_type_support_callbacks_t callbacks{
      message_namespace, message_name,        description.type_hash, Functions::write,  Functions::read,
      Functions::size,   Functions::max_size, &description,          Functions::create, Functions::destroy};
  static const rosidl_message_type_support_t handle{typesupport_identifier, &callbacks,
                                                    itself<rosidl_message_type_support_t>};
  return &handle;
}

// The event messages of a service, for code that knows the type only by its handle.
template <typename Service>
struct EventFunctions {
  static void* create(const rosidl_service_introspection_info_t* info, const void* request, const void* response) {
    try {
      auto event = std::make_unique<typename Service::Event>();
      event->info.event_type = info->event_type;
      event->info.stamp.sec = info->stamp_sec;
      event->info.stamp.nanosec = info->stamp_nanosec;
      std::copy(std::begin(info->client_gid), std::end(info->client_gid), event->info.client_gid.begin());
      event->info.sequence_number = info->sequence_number;
      if (request != nullptr) {
        event->request.push_back(*static_cast<const typename Service::Request*>(request));
      }
      if (response != nullptr) {
        event->response.push_back(*static_cast<const typename Service::Response*>(response));
      }
      return event.release();
    } catch (const std::bad_alloc&) {
      return nullptr;
    }
  }
  static void destroy(void* event) { delete static_cast<typename Service::Event*>(event); }
};

template <typename Service>
const rosidl_service_type_support_t* service_type_support(const char* service_namespace, const char* service_name,
                                                          const rosidl_type_description_t& description) {
  using rosidl_typesupport_cpp::get_message_type_support_handle;
  static const service_type_support_callbacks_t callbacks{
      service_namespace, service_name, get_message_type_support_handle<typename Service::Request>(),
      get_message_type_support_handle<typename Service::Response>(), &description};
  static const rosidl_service_type_support_t handle{typesupport_identifier,
                                                    &callbacks,
                                                    itself<rosidl_service_type_support_t>,
                                                    callbacks.request_members_,
                                                    callbacks.response_members_,
                                                    get_message_type_support_handle<typename Service::Event>(),
                                                    EventFunctions<Service>::create,
                                                    EventFunctions<Service>::destroy};
  return &handle;
}

}  // namespace rosidl_typesupport_fastrtps_cpp
