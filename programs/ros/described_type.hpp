// SPDX-License-Identifier: Apache-2.0
// Type supports made from interface files, for messages of which no generated code is at hand.
//
// Where the middleware takes a pointer to a message, it gets a DescribedMessage.
#pragma once

#include <rosidl_runtime_c/message_type_support_struct.h>
#include <rosidl_runtime_c/service_type_support_struct.h>
#include <rosidl_typesupport_fastrtps_cpp/message_type_support.h>
#include <rosidl_typesupport_fastrtps_cpp/service_type_support.h>

#include <memory>
#include <string>

#include "launcher/message_types/interface_type.hpp"

namespace launch {

struct DescribedMessage {
  std::shared_ptr<const MessageType> type;
  MessageValue value;
};

// Must live as long as the endpoints that use it.
class DescribedType {
 public:
  explicit DescribedType(std::shared_ptr<const MessageType> type);
  DescribedType(const DescribedType&) = delete;
  DescribedType& operator=(const DescribedType&) = delete;

  const std::shared_ptr<const MessageType>& type() const { return type_; }
  const rosidl_message_type_support_t& handle() const { return handle_; }

 private:
  std::shared_ptr<const MessageType> type_;
  std::string name_space_;  // "std_msgs::msg"
  std::string name_;
  message_type_support_callbacks_t callbacks_{};
  rosidl_message_type_support_t handle_{};
};

class DescribedService {
 public:
  explicit DescribedService(const ServiceType& type);
  DescribedService(const DescribedService&) = delete;
  DescribedService& operator=(const DescribedService&) = delete;

  const DescribedType& request() const { return request_; }
  const DescribedType& response() const { return response_; }
  const rosidl_service_type_support_t& handle() const { return handle_; }

 private:
  DescribedType request_;
  DescribedType response_;
  std::string name_space_;  // "std_srvs::srv"
  std::string name_;
  service_type_support_callbacks_t callbacks_{};
  rosidl_service_type_support_t handle_{};
};

}  // namespace launch
