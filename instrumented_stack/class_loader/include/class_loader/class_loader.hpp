// SPDX-License-Identifier: Apache-2.0
// Creates objects of the classes in one shared library, which is loaded at run time.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <typeinfo>
#include <vector>

#include "class_loader/detail/class_registry.hpp"
#include "class_loader/exceptions.hpp"
#include "class_loader/register_macro.hpp"

namespace class_loader {

// ".so".
std::string systemLibrarySuffix();
// "libshapes.so" for "shapes".
std::string systemLibraryFormat(const std::string& library_name);

// Thread safe. Objects keep the library: it goes with the loader, or unloadLibrary(), or later with the last of them.
class ClassLoader {
 public:
  template <typename Base>
  using DeleterType = std::function<void(Base*)>;
  template <typename Base>
  using UniquePtr = std::unique_ptr<Base, DeleterType<Base>>;

  // `library_path` as dlopen() takes it; empty for the libraries that the program was linked with. Loads it at once, or
  // with the first object if `ondemand_load_unload`. Throws LibraryLoadException.
  explicit ClassLoader(const std::string& library_path, bool ondemand_load_unload = false);
  virtual ~ClassLoader();
  ClassLoader(const ClassLoader&) = delete;
  ClassLoader& operator=(const ClassLoader&) = delete;

  // Of a library that is not loaded: none.
  template <typename Base>
  std::vector<std::string> getAvailableClasses() const {
    return classes_of(typeid(Base));
  }
  template <typename Base>
  bool isClassAvailable(const std::string& class_name) const {
    for (const std::string& available : getAvailableClasses<Base>()) {
      if (available == class_name) {
        return true;
      }
    }
    return false;
  }

  // Throw CreateClassException for a class that there is not, or whose library is not loaded.
  template <typename Base>
  std::shared_ptr<Base> createSharedInstance(const std::string& derived_class_name) {
    return createUniqueInstance<Base>(derived_class_name);
  }
  template <typename Base>
  std::shared_ptr<Base> createInstance(const std::string& derived_class_name) {
    return createSharedInstance<Base>(derived_class_name);
  }
  template <typename Base>
  UniquePtr<Base> createUniqueInstance(const std::string& derived_class_name) {
    std::shared_ptr<void> library;
    auto* const object = static_cast<Base*>(create(typeid(Base), derived_class_name, library));
    return UniquePtr<Base>(object, [library](Base* created) { delete created; });
  }
  // For the caller to delete. The library then stays to the end of the process.
  template <typename Base>
  Base* createUnmanagedInstance(const std::string& derived_class_name) {
    std::shared_ptr<void> library;
    auto* const object = static_cast<Base*>(create(typeid(Base), derived_class_name, library));
    keep_for_ever(library);
    return object;
  }

  std::string getLibraryPath() const { return library_path_; }
  bool isLibraryLoaded() const;
  bool isLibraryLoadedByAnyClassloader() const;
  bool isOnDemandLoadUnloadEnabled() const { return on_demand_; }

  // Throws LibraryLoadException with what the dynamic loader says.
  void loadLibrary();
  // To be called as often as loadLibrary(), the constructor's call included; how often that still is.
  int unloadLibrary();

 private:
  std::vector<std::string> classes_of(const std::type_info& base) const;
  void* create(const std::type_info& base, const std::string& class_name, std::shared_ptr<void>& library);
  static void keep_for_ever(const std::shared_ptr<void>& library);

  const std::string library_path_;
  const bool on_demand_;
  mutable std::mutex mutex_;
  std::shared_ptr<void> library_;     // null: not loaded by this loader
  std::weak_ptr<void> last_library_;  // of objects that outlive the on-demand loading
  std::string name_;                  // as registrations know the library
  int loads_ = 0;
};

}  // namespace class_loader
