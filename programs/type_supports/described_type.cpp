// SPDX-License-Identifier: Apache-2.0
#include "programs/type_supports/described_type.hpp"

#include <fastcdr/Cdr.h>
#include <rosidl_typesupport_fastrtps_cpp/message_type_support.h>
#include <rosidl_typesupport_fastrtps_cpp/service_type_support.h>

#include <cstring>
#include <exception>
#include <rosidl_typesupport_fastrtps_cpp/identifier.hpp>
#include <string>
#include <tuple>
#include <utility>

#include "launcher/message_types/cdr/cdr_codec.hpp"

namespace launch {

// What the middleware's pointer to a message points to.
struct DescribedMessage {
  std::shared_ptr<const MessageType> type;
  MessageValue value;
};

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

struct DescribedType::Support {
  std::string name_space;  // "std_msgs::msg"
  std::string name;
  message_type_support_callbacks_t callbacks{};
  rosidl_message_type_support_t handle{};
};

DescribedType::DescribedType(std::shared_ptr<const MessageType> type)
    : type_(std::move(type)), support_(std::make_unique<Support>()) {
  std::tie(support_->name_space, support_->name) = cpp_names(type_->name);
  message_type_support_callbacks_t& callbacks = support_->callbacks;
  callbacks.message_namespace_ = support_->name_space.c_str();
  callbacks.message_name_ = support_->name.c_str();
  callbacks.type_hash_ = "";
  callbacks.cdr_serialize = write;
  callbacks.cdr_deserialize = read;
  callbacks.get_serialized_size = size;
  callbacks.max_serialized_size = max_size;
  support_->handle = {rosidl_typesupport_fastrtps_cpp::typesupport_identifier, &callbacks,
                      itself<rosidl_message_type_support_t>};
}

DescribedType::~DescribedType() = default;

const rosidl_message_type_support_t& DescribedType::handle() const {
  return support_->handle;
}

struct NativeMessage::Storage {
  explicit Storage(DescribedMessage of) : message(std::move(of)) {}

  DescribedMessage message;
};

NativeMessage::NativeMessage(const DescribedType& type) : NativeMessage(type, {}) {}

NativeMessage::NativeMessage(const DescribedType& type, const MessageValue& value)
    : type_(type), storage_(std::make_unique<Storage>(DescribedMessage{type.type(), value})) {}

NativeMessage::~NativeMessage() = default;

void* NativeMessage::data() {
  return &storage_->message;
}

MessageValue NativeMessage::value() const {
  return storage_->message.value;
}

struct DescribedService::Support {
  std::string name_space;  // "std_srvs::srv"
  std::string name;
  service_type_support_callbacks_t callbacks{};
  rosidl_service_type_support_t handle{};
};

DescribedService::DescribedService(const ServiceType& type)
    : request_(type.request), response_(type.response), support_(std::make_unique<Support>()) {
  std::tie(support_->name_space, support_->name) = cpp_names(type.name);
  service_type_support_callbacks_t& callbacks = support_->callbacks;
  callbacks.service_namespace_ = support_->name_space.c_str();
  callbacks.service_name_ = support_->name.c_str();
  callbacks.request_members_ = &request_.handle();
  callbacks.response_members_ = &response_.handle();
  rosidl_service_type_support_t& handle = support_->handle;
  handle.typesupport_identifier = rosidl_typesupport_fastrtps_cpp::typesupport_identifier;
  handle.data = &callbacks;
  handle.func = itself<rosidl_service_type_support_t>;
  handle.request_typesupport = &request_.handle();
  handle.response_typesupport = &response_.handle();
}

DescribedService::~DescribedService() = default;

const rosidl_service_type_support_t& DescribedService::handle() const {
  return support_->handle;
}

}  // namespace launch
