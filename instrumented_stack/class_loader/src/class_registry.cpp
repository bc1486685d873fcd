// SPDX-License-Identifier: Apache-2.0
#include "class_loader/detail/class_registry.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <mutex>

namespace class_loader::detail {

namespace {

// The threads that load and unload libraries add and remove registrations.
struct Registry {
  std::mutex mutex;
  std::vector<const Registration*> registrations;
};

Registry& registry() {
  static Registry instance;
  return instance;
}

thread_local int loads_of_thread = 0;

std::string library_of(const void* object) {
  Dl_info info{};
  return dladdr(object, &info) != 0 && info.dli_fname != nullptr ? info.dli_fname : "";
}

bool is_one_of(const Registration& registration, const std::string& library, const std::type_info& base) {
  const bool is_in = library.empty() ? registration.is_linked : registration.library == library;
  return is_in && registration.base == base.name();
}

}  // namespace

Registration::Registration(const char* name, const std::type_info& base_class, Create create_object)
    : class_name(name),
      base(base_class.name()),
      create(create_object),
      library(library_of(this)),
      is_linked(loads_of_thread == 0) {
  const std::lock_guard lock(registry().mutex);
  registry().registrations.push_back(this);
}

Registration::~Registration() {
  const std::lock_guard lock(registry().mutex);
  auto& registrations = registry().registrations;
  registrations.erase(std::remove(registrations.begin(), registrations.end(), this), registrations.end());
}

Loading::Loading() {
  ++loads_of_thread;
}

Loading::~Loading() {
  --loads_of_thread;
}

std::vector<std::string> classes_in(const std::string& library, const std::type_info& base) {
  std::vector<std::string> classes;
  const std::lock_guard lock(registry().mutex);
  for (const Registration* registration : registry().registrations) {
    if (is_one_of(*registration, library, base)) {
      classes.push_back(registration->class_name);
    }
  }
  return classes;
}

Registration::Create find_class(const std::string& library, const std::type_info& base, const std::string& class_name) {
  const std::lock_guard lock(registry().mutex);
  for (const Registration* registration : registry().registrations) {
    if (is_one_of(*registration, library, base) && registration->class_name == class_name) {
      return registration->create;
    }
  }
  return nullptr;
}

}  // namespace class_loader::detail
