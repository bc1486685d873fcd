// SPDX-License-Identifier: Apache-2.0
#include "programs/companion/installed_types/installed_library.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <rclcpp/typesupport_helpers.hpp>
#include <stdexcept>
#include <string_view>

namespace launch {

namespace {

constexpr const char* kKind = "rosidl_typesupport_cpp";

std::string package_of(const std::string& type) {
  return type.substr(0, type.find('/'));
}

rcpputils::SharedLibrary& library_of(const std::string& type) {
  static std::map<std::string, std::shared_ptr<rcpputils::SharedLibrary>> libraries;
  std::shared_ptr<rcpputils::SharedLibrary>& library = libraries[package_of(type)];
  if (!library) {
    library = rclcpp::get_typesupport_library(type, kKind);
  }
  return *library;
}

// Calls the function of the library, which has no arguments and returns a pointer to the handle.
template <typename Handle>
const Handle& handle_from(const std::string& type, const std::string& symbol) {
  try {
    const auto get = reinterpret_cast<const Handle* (*)()>(library_of(type).get_symbol(symbol));
    return *get();
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("no type support of '{}': {}", type, error.what()));
  }
}

// "std_msgs/msg/String" -> "std_msgs__msg__String"
std::string c_name(const std::string& type) {
  std::string name;
  for (const char c : type) {
    name += c == '/' ? std::string("__") : std::string(1, c);
  }
  return name;
}

// "std_msgs/srv/Empty" -> "8std_msgs3srv5Empty", as compilers write it in names of functions
std::string mangled_name(std::string_view type) {
  std::string name;
  while (!type.empty()) {
    const std::string_view part = type.substr(0, type.find('/'));
    name += fmt::format("{}{}", part.size(), part);
    type.remove_prefix(std::min(part.size() + 1, type.size()));
  }
  return name;
}

}  // namespace

const rosidl_message_type_support_t& installed_message(const std::string& type) {
  return handle_from<rosidl_message_type_support_t>(
      type, fmt::format("{}__get_message_type_support_handle__{}", kKind, c_name(type)));
}

// Humble has no function of C for it. That of C++ has the same name in all distributions:
// rosidl_typesupport_cpp::get_service_type_support_handle<std_msgs::srv::Empty>().
const rosidl_service_type_support_t& installed_service(const std::string& type) {
  return handle_from<rosidl_service_type_support_t>(
      type, fmt::format("_ZN{}{}31get_service_type_support_handleIN{}EEEPK29rosidl_service_type_support_tv",
                        std::string_view(kKind).size(), kKind, mangled_name(type)));
}

}  // namespace launch
