// SPDX-License-Identifier: Apache-2.0
// Creates objects of the classes in one shared library, which is loaded at run time.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <typeinfo>
#include <utility>
#include <vector>

#include "class_loader/detail/class_registry.hpp"
#include "class_loader/exceptions.hpp"
#include "class_loader/interface_traits.hpp"
#include "class_loader/register_macro.hpp"

namespace class_loader {

// ".so".
std::string systemLibrarySuffix();
// "libshapes.so" for "shapes".
std::string systemLibraryFormat(const std::string& library_name);

// Thread safe. Objects keep the library loaded. It is unloaded with the loader, by unloadLibrary(), or later with the
// last object.
class ClassLoader {
 public:
  template <typename Base>
  using DeleterType = std::function<void(Base*)>;
  template <typename Base>
  using UniquePtr = std::unique_ptr<Base, DeleterType<Base>>;

  // `library_path` is passed to dlopen(); empty means the libraries that the program was linked with. Loads the library
  // at once, or for the first object if `ondemand_load_unload`. Throws LibraryLoadException.
  explicit ClassLoader(const std::string& library_path, bool ondemand_load_unload = false);
  virtual ~ClassLoader();
  ClassLoader(const ClassLoader&) = delete;
  ClassLoader& operator=(const ClassLoader&) = delete;

  // Empty if the library is not loaded.
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

  // `arguments` go to the constructor; their types are told by InterfaceTraits<Base>, and without it there are none.
  // Throw CreateClassException if the class does not exist or its library is not loaded.
  template <typename Base, typename... Arguments>
  std::shared_ptr<Base> createSharedInstance(const std::string& derived_class_name, Arguments&&... arguments) {
    return createUniqueInstance<Base>(derived_class_name, std::forward<Arguments>(arguments)...);
  }
  template <typename Base, typename... Arguments>
  std::shared_ptr<Base> createInstance(const std::string& derived_class_name, Arguments&&... arguments) {
    return createSharedInstance<Base>(derived_class_name, std::forward<Arguments>(arguments)...);
  }
  template <typename Base, typename... Arguments>
  UniquePtr<Base> createUniqueInstance(const std::string& derived_class_name, Arguments&&... arguments) {
    std::shared_ptr<void> library;
    Base* const object = create<Base>(derived_class_name, library, std::forward<Arguments>(arguments)...);
    return UniquePtr<Base>(object, [library](Base* created) { delete created; });
  }
  // The caller deletes the object. The library then stays loaded until the process ends.
  template <typename Base, typename... Arguments>
  Base* createUnmanagedInstance(const std::string& derived_class_name, Arguments&&... arguments) {
    std::shared_ptr<void> library;
    Base* const object = create<Base>(derived_class_name, library, std::forward<Arguments>(arguments)...);
    keep_for_ever(library);
    return object;
  }

  std::string getLibraryPath() const { return library_path_; }
  bool isLibraryLoaded() const;
  bool isLibraryLoadedByAnyClassloader() const;
  bool isOnDemandLoadUnloadEnabled() const { return on_demand_; }

  // Throws LibraryLoadException with the message of the dynamic loader.
  void loadLibrary();
  // Call it as often as loadLibrary(), including the constructor's call. Returns how many calls are still needed.
  int unloadLibrary();

 private:
  std::vector<std::string> classes_of(const std::type_info& base) const;
  template <typename Base, typename... Arguments>
  Base* create(const std::string& class_name, std::shared_ptr<void>& library, Arguments&&... arguments) {
    static_assert(detail::Factory<Base>::template takes<Arguments...>,
                  "The constructor of the class takes other arguments: see class_loader::InterfaceTraits<Base>.");
    const auto factory = find(typeid(Base), class_name, library);
    return detail::Factory<Base>::create(factory, std::forward<Arguments>(arguments)...);
  }
  // Loads the library if it is loaded on demand.
  detail::Registration::Create find(const std::type_info& base, const std::string& class_name,
                                    std::shared_ptr<void>& library);
  static void keep_for_ever(const std::shared_ptr<void>& library);

  const std::string library_path_;
  const bool on_demand_;
  mutable std::mutex mutex_;
  std::shared_ptr<void> library_;     // null: not loaded by this loader
  std::weak_ptr<void> last_library_;  // for objects that outlive on-demand loading
  std::string name_;                  // as in registrations
  int loads_ = 0;
};

}  // namespace class_loader
