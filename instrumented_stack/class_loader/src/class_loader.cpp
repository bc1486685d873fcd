// SPDX-License-Identifier: Apache-2.0
#include "class_loader/class_loader.hpp"

#include <dlfcn.h>
#include <link.h>

#include <mutex>
#include <vector>

namespace class_loader {

namespace {

std::shared_ptr<void> open(const std::string& path) {
  // Another thread may load libraries meanwhile; it makes their registrations itself.
  const detail::Loading loading;
  // RTLD_NOW: an undefined symbol is reported here; otherwise it would end the program in some function. RTLD_LOCAL:
  // classes of different libraries may have functions with the same name.
  void* const handle = dlopen(path.empty() ? nullptr : path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    throw LibraryLoadException("cannot load the library '" + path + "': " + dlerror());
  }
  return {handle, [](void* opened) { dlclose(opened); }};
}

std::string name_of(void* handle) {
  link_map* map = nullptr;
  return dlinfo(handle, RTLD_DI_LINKMAP, &map) == 0 ? map->l_name : "";
}

}  // namespace

std::string systemLibrarySuffix() {
  return ".so";
}

std::string systemLibraryFormat(const std::string& library_name) {
  return "lib" + library_name + systemLibrarySuffix();
}

ClassLoader::ClassLoader(const std::string& library_path, bool ondemand_load_unload)
    : library_path_(library_path), on_demand_(ondemand_load_unload) {
  if (!on_demand_) {
    loadLibrary();
  }
}

ClassLoader::~ClassLoader() = default;

bool ClassLoader::isLibraryLoaded() const {
  const std::lock_guard lock(mutex_);
  return library_ != nullptr || !last_library_.expired();
}

bool ClassLoader::isLibraryLoadedByAnyClassloader() const {
  void* const handle = dlopen(library_path_.empty() ? nullptr : library_path_.c_str(), RTLD_LAZY | RTLD_NOLOAD);
  if (handle == nullptr) {
    return false;
  }
  dlclose(handle);
  return true;
}

void ClassLoader::loadLibrary() {
  const std::lock_guard lock(mutex_);
  if (library_ == nullptr) {
    library_ = open(library_path_);
    last_library_ = library_;
    name_ = name_of(library_.get());
  }
  ++loads_;
}

int ClassLoader::unloadLibrary() {
  const std::lock_guard lock(mutex_);
  if (loads_ > 0 && --loads_ == 0) {
    library_.reset();
  }
  return loads_;
}

std::vector<std::string> ClassLoader::classes_of(const std::type_info& base) const {
  const std::lock_guard lock(mutex_);
  return last_library_.expired() ? std::vector<std::string>() : detail::classes_in(name_, base);
}

detail::Registration::Create ClassLoader::find(const std::type_info& base, const std::string& class_name,
                                               std::shared_ptr<void>& library) {
  const std::lock_guard lock(mutex_);
  library = last_library_.lock();
  if (library == nullptr && on_demand_) {
    library = open(library_path_);
    last_library_ = library;
    name_ = name_of(library.get());
  }
  if (library == nullptr) {
    throw CreateClassException("cannot create an object of class '" + class_name + "': the library '" + library_path_ +
                               "' is not loaded");
  }
  const auto create_object = detail::find_class(name_, base, class_name);
  if (create_object == nullptr) {
    throw CreateClassException("cannot create an object of class '" + class_name + "': the library '" + library_path_ +
                               "' has no such class with that base class");
  }
  return create_object;
}

void ClassLoader::keep_for_ever(const std::shared_ptr<void>& library) {
  static std::mutex mutex;
  // Never destroyed, so that no library is closed when the process ends.
  static auto& libraries = *new std::vector<std::shared_ptr<void>>;
  const std::lock_guard lock(mutex);
  libraries.push_back(library);
}

}  // namespace class_loader
