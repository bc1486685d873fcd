// SPDX-License-Identifier: Apache-2.0
// Finds type supports by the name of the type, in the libraries of message packages.
#pragma once

#include <rosidl_runtime_c/action_type_support_struct.h>
#include <rosidl_runtime_c/message_type_support_struct.h>
#include <rosidl_runtime_c/service_type_support_struct.h>

#include <memory>
#include <string>

#include "rclcpp/macros.hpp"

namespace rclcpp {

// A library. It stays loaded until the process ends, because the middleware keeps pointers into it.
class SharedLibrary {
 public:
  // Throws std::runtime_error with the loader's reason.
  explicit SharedLibrary(const std::string& path);
  ~SharedLibrary();
  RCLCPP_DISABLE_COPY(SharedLibrary)

  const std::string& get_library_path() const { return path_; }
  bool has_symbol(const std::string& symbol) const;
  // Throws std::runtime_error, which names symbol and library.
  void* get_symbol(const std::string& symbol) const;

 private:
  std::string path_;
  void* handle_;
};

// The library of the package of a type such as "std_msgs/msg/String" or "std_srvs/srv/Empty". It is searched in
// AMENT_PREFIX_PATH, then by the loader. `typesupport_identifier` is "rosidl_typesupport_cpp". Throws
// std::runtime_error if the name is malformed or the library does not exist.
std::shared_ptr<SharedLibrary> get_typesupport_library(const std::string& type,
                                                       const std::string& typesupport_identifier);

// "std_msgs/String" works too. Throw std::runtime_error if the library does not have the type.
const rosidl_message_type_support_t* get_message_typesupport_handle(const std::string& type,
                                                                    const std::string& typesupport_identifier,
                                                                    const SharedLibrary& library);
const rosidl_service_type_support_t* get_service_typesupport_handle(const std::string& type,
                                                                    const std::string& typesupport_identifier,
                                                                    const SharedLibrary& library);
const rosidl_action_type_support_t* get_action_typesupport_handle(const std::string& type,
                                                                  const std::string& typesupport_identifier,
                                                                  const SharedLibrary& library);

namespace detail {

// Throws exceptions::InvalidServiceTypeError, with the reason, if there is no such type.
const rosidl_service_type_support_t* find_service_type_support(const std::string& type);

}  // namespace detail

}  // namespace rclcpp
