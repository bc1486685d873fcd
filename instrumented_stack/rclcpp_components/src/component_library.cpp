// SPDX-License-Identifier: Apache-2.0
#include "rclcpp_components/component_library.hpp"

#include <dlfcn.h>
#include <link.h>

#include <algorithm>
#include <mutex>
#include <stdexcept>

#include "rclcpp_components/node_main.hpp"
#include "rclcpp_components/single_threaded_node_main.hpp"

namespace rclcpp_components {

namespace {

// The threads that load libraries add registrations.
struct Registry {
  std::mutex mutex;
  std::vector<const ComponentRegistration*> registrations;
};

Registry& registry() {
  static Registry instance;
  return instance;
}

std::string library_of(const void* object) {
  Dl_info info{};
  return dladdr(object, &info) != 0 && info.dli_fname != nullptr ? info.dli_fname : "";
}

template <typename MatchesT>
std::shared_ptr<NodeFactory> create_first(MatchesT matches) {
  ComponentRegistration::CreateFactory create = nullptr;
  {
    const std::lock_guard lock(registry().mutex);
    const auto& registrations = registry().registrations;
    const auto found = std::find_if(registrations.begin(), registrations.end(),
                                    [&](const ComponentRegistration* registration) { return matches(*registration); });
    if (found != registrations.end()) {
      create = (*found)->create_factory;
    }
  }
  return create != nullptr ? create() : nullptr;
}

}  // namespace

ComponentLibrary::ComponentLibrary(const std::string& path) {
  // RTLD_NOW: a library with an undefined symbol is refused here; otherwise it would end the container in some
  // callback. RTLD_LOCAL: components of different libraries may have functions with the same name.
  void* handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    throw std::runtime_error(dlerror());
  }
  link_map* map = nullptr;
  if (dlinfo(handle, RTLD_DI_LINKMAP, &map) != 0) {
    throw std::runtime_error(dlerror());
  }
  name_ = map->l_name;
}

std::vector<std::string> ComponentLibrary::get_available_classes() const {
  std::vector<std::string> classes;
  const std::lock_guard lock(registry().mutex);
  for (const ComponentRegistration* registration : registry().registrations) {
    if (registration->library == name_) {
      classes.push_back(registration->class_name);
    }
  }
  return classes;
}

std::shared_ptr<NodeFactory> ComponentLibrary::create_factory(const std::string& class_name) const {
  return create_first([&](const ComponentRegistration& registration) {
    return registration.library == name_ && registration.class_name == class_name;
  });
}

std::shared_ptr<NodeFactory> create_component_factory(const std::string& class_name) {
  return create_first([&](const ComponentRegistration& registration) { return registration.class_name == class_name; });
}

ComponentRegistration::ComponentRegistration(const char* name, CreateFactory create)
    : class_name(name), create_factory(create), library(library_of(this)) {
  const std::lock_guard lock(registry().mutex);
  registry().registrations.push_back(this);
}

ComponentRegistration::~ComponentRegistration() {
  const std::lock_guard lock(registry().mutex);
  auto& registrations = registry().registrations;
  registrations.erase(std::remove(registrations.begin(), registrations.end(), this), registrations.end());
}

int single_threaded_node_main(const char* class_name, int argc, char** argv) {
  return node_main<rclcpp::executors::SingleThreadedExecutor>(class_name, argc, argv);
}

}  // namespace rclcpp_components
