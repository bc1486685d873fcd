// SPDX-License-Identifier: Apache-2.0
// The types of programs/type_supports/ for any middleware: messages are those of the generated code, made and read by
// the introspection of rosidl, and the middleware converts them from and to bytes.
#include <fmt/format.h>
#include <rmw/error_handling.h>
#include <rmw/rmw.h>
#include <rmw/serialized_message.h>

#include <algorithm>
#include <cstddef>
#include <rclcpp/serialized_message.hpp>
#include <rosidl_typesupport_introspection_cpp/identifier.hpp>
#include <rosidl_typesupport_introspection_cpp/message_introspection.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

#include "launcher/message_types/cdr/cdr_codec.hpp"
#include "programs/companion/installed_types/installed_library.hpp"
#include "programs/type_supports/described_type.hpp"
#include "programs/type_supports/opaque_type.hpp"

namespace launch {

namespace {

using rosidl_typesupport_introspection_cpp::MessageMembers;

void require_ok(rmw_ret_t ret, const char* what, const std::string& type) {
  if (ret != RMW_RET_OK) {
    const std::string why = rmw_get_error_string().str;
    rmw_reset_error();
    throw std::runtime_error(fmt::format("cannot {} a message of '{}': {}", what, type, why));
  }
}

const MessageMembers& members_of(const rosidl_message_type_support_t& handle, const std::string& type) {
  const rosidl_message_type_support_t* const found =
      get_message_typesupport_handle(&handle, rosidl_typesupport_introspection_cpp::typesupport_identifier);
  if (found == nullptr) {
    throw std::runtime_error(fmt::format("the package of '{}' was built without introspection", type));
  }
  return *static_cast<const MessageMembers*>(found->data);
}

}  // namespace

const rosidl_message_type_support_t& opaque_type(const std::string& type) {
  return installed_message(type);
}

struct DescribedType::Support {
  const rosidl_message_type_support_t& handle;
  const MessageMembers& members;
};

DescribedType::DescribedType(std::shared_ptr<const MessageType> type) : type_(std::move(type)) {
  const rosidl_message_type_support_t& handle = installed_message(type_->name);
  support_ = std::unique_ptr<Support>(new Support{handle, members_of(handle, type_->name)});
}

DescribedType::~DescribedType() = default;

const rosidl_message_type_support_t& DescribedType::handle() const {
  return support_->handle;
}

// Memory for a message of the generated code.
struct NativeMessage::Storage {
  explicit Storage(const MessageMembers& of)
      : members(of), memory((of.size_of_ + sizeof(std::max_align_t) - 1) / sizeof(std::max_align_t) + 1) {
    members.init_function(memory.data(), rosidl_runtime_cpp::MessageInitialization::ALL);
  }
  ~Storage() { members.fini_function(memory.data()); }
  Storage(const Storage&) = delete;
  Storage& operator=(const Storage&) = delete;

  const MessageMembers& members;
  std::vector<std::max_align_t> memory;
};

NativeMessage::NativeMessage(const DescribedType& type)
    : type_(type), storage_(std::make_unique<Storage>(type.support_->members)) {}

NativeMessage::NativeMessage(const DescribedType& type, const MessageValue& value) : NativeMessage(type) {
  const std::vector<std::uint8_t> bytes = to_cdr(*type.type(), value);
  rclcpp::SerializedMessage serialized(bytes.size());
  rmw_serialized_message_t& array = serialized.get_rcl_serialized_message();
  std::copy(bytes.begin(), bytes.end(), array.buffer);
  array.buffer_length = bytes.size();
  require_ok(rmw_deserialize(&array, &type.handle(), data()), "make", type.type()->name);
}

NativeMessage::~NativeMessage() = default;

void* NativeMessage::data() {
  return storage_->memory.data();
}

MessageValue NativeMessage::value() const {
  rclcpp::SerializedMessage serialized;
  rmw_serialized_message_t& array = serialized.get_rcl_serialized_message();
  require_ok(rmw_serialize(storage_->memory.data(), &type_.handle(), &array), "read", type_.type()->name);
  return from_cdr(*type_.type(), array.buffer, array.buffer_length);
}

struct DescribedService::Support {
  const rosidl_service_type_support_t& handle;
};

DescribedService::DescribedService(const ServiceType& type)
    : request_(type.request),
      response_(type.response),
      support_(std::unique_ptr<Support>(new Support{installed_service(type.name)})) {}

DescribedService::~DescribedService() = default;

const rosidl_service_type_support_t& DescribedService::handle() const {
  return support_->handle;
}

}  // namespace launch
