// SPDX-License-Identifier: Apache-2.0
// The middleware does not read messages that it gives as bytes, so their type need not be known when this program is
// built. DDS only asks a reader for the name of the type.
#include "programs/type_supports/opaque_type.hpp"

#include <rosidl_typesupport_fastrtps_cpp/message_type_support.h>

#include <cstring>
#include <map>
#include <rosidl_typesupport_fastrtps_cpp/identifier.hpp>

namespace launch {

namespace {

// The type support of a type of which only the name is known.
class OpaqueType {
 public:
  // "std_msgs/msg/String"
  explicit OpaqueType(const std::string& type) {
    const std::size_t separator = type.rfind('/');
    name_ = type.substr(separator == std::string::npos ? 0 : separator + 1);
    for (std::size_t i = 0; separator != std::string::npos && i < separator; ++i) {
      name_space_ += type[i] == '/' ? std::string("::") : std::string(1, type[i]);
    }
    callbacks_.message_namespace_ = name_space_.c_str();
    callbacks_.message_name_ = name_.c_str();
    callbacks_.type_hash_ = "";  // the definition of the type is not known
    callbacks_.cdr_serialize = write;
    callbacks_.cdr_deserialize = read;
    callbacks_.get_serialized_size = size;
    callbacks_.max_serialized_size = max_size;
    handle_ = {rosidl_typesupport_fastrtps_cpp::typesupport_identifier, &callbacks_, itself};
  }
  OpaqueType(const OpaqueType&) = delete;
  OpaqueType& operator=(const OpaqueType&) = delete;

  const rosidl_message_type_support_t& handle() const { return handle_; }

 private:
  static bool write(const void*, eprosima::fastcdr::Cdr&) { return false; }
  static bool read(eprosima::fastcdr::Cdr&, void*) { return false; }
  static uint32_t size(const void*) { return 0; }
  static size_t max_size(char& bounds_info) {
    bounds_info = ROSIDL_TYPESUPPORT_FASTRTPS_UNBOUNDED_TYPE;
    return 0;
  }
  static const rosidl_message_type_support_t* itself(const rosidl_message_type_support_t* handle,
                                                     const char* identifier) {
    return std::strcmp(identifier, handle->typesupport_identifier) == 0 ? handle : nullptr;
  }

  std::string name_space_;  // "std_msgs::msg"
  std::string name_;
  message_type_support_callbacks_t callbacks_{};
  rosidl_message_type_support_t handle_{};
};

}  // namespace

const rosidl_message_type_support_t& opaque_type(const std::string& type) {
  static std::map<std::string, OpaqueType> types;
  return types.try_emplace(type, type).first->second.handle();
}

}  // namespace launch
