// SPDX-License-Identifier: Apache-2.0
#include "programs/ros/described_type.hpp"

#include <fastcdr/Cdr.h>

#include <cstring>
#include <exception>
#include <rosidl_typesupport_fastrtps_cpp/identifier.hpp>
#include <utility>

#include "launcher/message_types/cdr/cdr_codec.hpp"

namespace launch {

namespace {

bool write(const void* untyped, eprosima::fastcdr::Cdr& cdr) {
  const auto& message = *static_cast<const DescribedMessage*>(untyped);
  try {
    write_cdr(*message.type, message.value, cdr);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

bool read(eprosima::fastcdr::Cdr& cdr, void* untyped) {
  auto& message = *static_cast<DescribedMessage*>(untyped);
  try {
    message.value = read_cdr(*message.type, cdr);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

std::uint32_t size(const void* untyped) {
  const auto& message = *static_cast<const DescribedMessage*>(untyped);
  return static_cast<std::uint32_t>(cdr_size(*message.type, message.value));
}

// The function is not told of which type. A type without a bound is asked for the size of each message.
std::size_t max_size(char& bounds_info) {
  bounds_info = ROSIDL_TYPESUPPORT_FASTRTPS_UNBOUNDED_TYPE;
  return 0;
}

template <typename Handle>
const Handle* itself(const Handle* handle, const char* identifier) {
  return std::strcmp(identifier, handle->typesupport_identifier) == 0 ? handle : nullptr;
}

// "std_msgs/msg/String" -> "std_msgs::msg", "String"
std::pair<std::string, std::string> cpp_names(const std::string& type) {
  const std::size_t separator = type.rfind('/');
  std::string name_space;
  for (const char c : type.substr(0, separator)) {
    name_space += c == '/' ? std::string("::") : std::string(1, c);
  }
  return {name_space, type.substr(separator + 1)};
}

}  // namespace

DescribedType::DescribedType(std::shared_ptr<const MessageType> type) : type_(std::move(type)) {
  std::tie(name_space_, name_) = cpp_names(type_->name);
  callbacks_.message_namespace_ = name_space_.c_str();
  callbacks_.message_name_ = name_.c_str();
  callbacks_.type_hash_ = "";
  callbacks_.cdr_serialize = write;
  callbacks_.cdr_deserialize = read;
  callbacks_.get_serialized_size = size;
  callbacks_.max_serialized_size = max_size;
  handle_ = {rosidl_typesupport_fastrtps_cpp::typesupport_identifier, &callbacks_,
             itself<rosidl_message_type_support_t>};
}

DescribedService::DescribedService(const ServiceType& type) : request_(type.request), response_(type.response) {
  std::tie(name_space_, name_) = cpp_names(type.name);
  callbacks_.service_namespace_ = name_space_.c_str();
  callbacks_.service_name_ = name_.c_str();
  callbacks_.request_members_ = &request_.handle();
  callbacks_.response_members_ = &response_.handle();
  handle_.typesupport_identifier = rosidl_typesupport_fastrtps_cpp::typesupport_identifier;
  handle_.data = &callbacks_;
  handle_.func = itself<rosidl_service_type_support_t>;
  handle_.request_typesupport = &request_.handle();
  handle_.response_typesupport = &response_.handle();
}

}  // namespace launch
