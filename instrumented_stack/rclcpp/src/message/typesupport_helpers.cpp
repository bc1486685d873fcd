// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/typesupport_helpers.hpp"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "rclcpp/exceptions.hpp"

namespace rclcpp {

namespace {

constexpr const char* kIdentifier = "rosidl_typesupport_cpp";

struct TypeName {
  std::string package;
  std::string kind;  // msg, srv or action; empty if the name does not contain it
  std::string name;
};

TypeName parse_type_name(const std::string& type) {
  const size_t first = type.find('/');
  const size_t last = type.rfind('/');
  if (first == std::string::npos || first == 0 || last + 1 == type.size()) {
    throw std::runtime_error("Message type '" + type + "' is not of the form package/type and cannot be processed");
  }
  const std::string kind = first == last ? "" : type.substr(first + 1, last - first - 1);
  if (kind.find('/') != std::string::npos) {
    throw std::runtime_error("Message type '" + type + "' is not of the form package/type and cannot be processed");
  }
  return {type.substr(0, first), kind, type.substr(last + 1)};
}

void require_identifier(const std::string& typesupport_identifier) {
  if (typesupport_identifier != kIdentifier) {
    throw std::runtime_error("there is no type support of kind '" + typesupport_identifier + "', only '" + kIdentifier +
                             "'");
  }
}

// A component of a name, mangled as in the C++ ABI.
std::string mangled(const std::string& name) {
  return std::to_string(name.size()) + name;
}

// The symbol of rosidl_typesupport_cpp::get_<kind>_type_support_handle<package::space::Name>().
std::string symbol_of(const TypeName& type, const std::string& kind, const std::string& space) {
  const std::string function = "get_" + kind + "_type_support_handle";
  const std::string result = "rosidl_" + kind + "_type_support_t";
  return "_ZN" + mangled(kIdentifier) + mangled(function) + "IN" + mangled(type.package) + mangled(space) +
         mangled(type.name) + "EEEPK" + mangled(result) + "v";
}

template <typename HandleT>
const HandleT* get_handle(const std::string& type, const std::string& typesupport_identifier,
                          const SharedLibrary& library, const std::string& kind, const std::string& space) {
  require_identifier(typesupport_identifier);
  TypeName name = parse_type_name(type);
  if (name.kind.empty()) {
    name.kind = space;
  }
  const std::string symbol = symbol_of(name, kind, name.kind);
  if (!library.has_symbol(symbol)) {
    throw std::runtime_error("no type '" + type + "' in library '" + library.get_library_path() + "'");
  }
  return reinterpret_cast<const HandleT* (*)()>(library.get_symbol(symbol))();
}

}  // namespace

SharedLibrary::SharedLibrary(const std::string& path)
    : path_(path), handle_(dlopen(path.c_str(), RTLD_LAZY | RTLD_NODELETE)) {
  if (!handle_) {
    const char* reason = dlerror();
    throw std::runtime_error("could not load library '" + path + "': " + (reason ? reason : "unknown reason"));
  }
}

SharedLibrary::~SharedLibrary() {
  dlclose(handle_);
}

bool SharedLibrary::has_symbol(const std::string& symbol) const {
  return dlsym(handle_, symbol.c_str()) != nullptr;
}

void* SharedLibrary::get_symbol(const std::string& symbol) const {
  void* address = dlsym(handle_, symbol.c_str());
  if (!address) {
    throw std::runtime_error("no symbol '" + symbol + "' in library '" + path_ + "'");
  }
  return address;
}

std::shared_ptr<SharedLibrary> get_typesupport_library(const std::string& type,
                                                       const std::string& typesupport_identifier) {
  require_identifier(typesupport_identifier);
  const std::string file = "lib" + parse_type_name(type).package + ".so";
  const char* prefixes = std::getenv("AMENT_PREFIX_PATH");
  std::istringstream list(prefixes ? prefixes : "");
  for (std::string prefix; std::getline(list, prefix, ':');) {
    const std::filesystem::path path = std::filesystem::path(prefix) / "lib" / file;
    if (!prefix.empty() && std::filesystem::exists(path)) {
      return std::make_shared<SharedLibrary>(path.string());
    }
  }
  return std::make_shared<SharedLibrary>(file);
}

const rosidl_message_type_support_t* get_message_typesupport_handle(const std::string& type,
                                                                    const std::string& typesupport_identifier,
                                                                    const SharedLibrary& library) {
  return get_handle<rosidl_message_type_support_t>(type, typesupport_identifier, library, "message", "msg");
}

const rosidl_service_type_support_t* get_service_typesupport_handle(const std::string& type,
                                                                    const std::string& typesupport_identifier,
                                                                    const SharedLibrary& library) {
  return get_handle<rosidl_service_type_support_t>(type, typesupport_identifier, library, "service", "srv");
}

const rosidl_action_type_support_t* get_action_typesupport_handle(const std::string& type,
                                                                  const std::string& typesupport_identifier,
                                                                  const SharedLibrary& library) {
  return get_handle<rosidl_action_type_support_t>(type, typesupport_identifier, library, "action", "action");
}

const rosidl_service_type_support_t* detail::find_service_type_support(const std::string& type) {
  try {
    return get_service_typesupport_handle(type, kIdentifier, *get_typesupport_library(type, kIdentifier));
  } catch (const std::runtime_error& error) {
    throw exceptions::InvalidServiceTypeError(error.what());
  }
}

}  // namespace rclcpp
