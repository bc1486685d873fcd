// SPDX-License-Identifier: Apache-2.0
// Creates objects of the classes in any number of shared libraries.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "class_loader/class_loader.hpp"

namespace class_loader {

namespace detail {

// After the name of a class come the arguments of its constructor, or the path of its library and then the arguments.
// So an overload exists only if the constructor takes them.
template <typename Base, typename... Arguments>
using IfTaken = std::enable_if_t<Factory<Base>::template takes<Arguments...>, bool>;

}  // namespace detail

// Not thread safe, unlike its loaders.
class MultiLibraryClassLoader {
 public:
  explicit MultiLibraryClassLoader(bool enable_ondemand_loadunload) : on_demand_(enable_ondemand_loadunload) {}

  // Throws LibraryLoadException. Does nothing if the library is loaded already.
  void loadLibrary(const std::string& library_path);
  // Returns how many calls are still needed: 0. Throws LibraryUnloadException if the library is not loaded.
  int unloadLibrary(const std::string& library_path);
  bool isLibraryAvailable(const std::string& library_path) const { return loaders_.count(library_path) != 0; }
  std::vector<std::string> getRegisteredLibraries() const;

  template <typename Base>
  std::vector<std::string> getAvailableClasses() const {
    std::vector<std::string> classes;
    for (const auto& [path, loader] : loaders_) {
      const std::vector<std::string> of_library = loader->template getAvailableClasses<Base>();
      classes.insert(classes.end(), of_library.begin(), of_library.end());
    }
    return classes;
  }
  template <typename Base>
  std::vector<std::string> getAvailableClassesForLibrary(const std::string& library_path) const {
    return loader_for(library_path).getAvailableClasses<Base>();
  }
  template <typename Base>
  bool isClassAvailable(const std::string& class_name) const {
    for (const auto& [path, loader] : loaders_) {
      if (loader->template isClassAvailable<Base>(class_name)) {
        return true;
      }
    }
    return false;
  }

  // The first library (sorted by path) that has the class is used. `arguments` go to the constructor, see
  // interface_traits.hpp. Throw CreateClassException, and NoClassLoaderExistsException if the library is not loaded.
  template <typename Base, typename... Arguments, detail::IfTaken<Base, Arguments...> = true>
  std::shared_ptr<Base> createInstance(const std::string& class_name, Arguments&&... arguments) {
    return loader_of<Base>(class_name).template createInstance<Base>(class_name, std::forward<Arguments>(arguments)...);
  }
  template <typename Base, typename... Arguments, detail::IfTaken<Base, Arguments...> = true>
  ClassLoader::UniquePtr<Base> createUniqueInstance(const std::string& class_name, Arguments&&... arguments) {
    return loader_of<Base>(class_name)
        .template createUniqueInstance<Base>(class_name, std::forward<Arguments>(arguments)...);
  }
  template <typename Base, typename... Arguments, detail::IfTaken<Base, Arguments...> = true>
  Base* createUnmanagedInstance(const std::string& class_name, Arguments&&... arguments) {
    return loader_of<Base>(class_name)
        .template createUnmanagedInstance<Base>(class_name, std::forward<Arguments>(arguments)...);
  }
  // The class of one library.
  template <typename Base, typename... Arguments, detail::IfTaken<Base, Arguments...> = true>
  std::shared_ptr<Base> createInstance(const std::string& class_name, const std::string& library_path,
                                       Arguments&&... arguments) {
    return loader_for(library_path).createInstance<Base>(class_name, std::forward<Arguments>(arguments)...);
  }
  template <typename Base, typename... Arguments, detail::IfTaken<Base, Arguments...> = true>
  ClassLoader::UniquePtr<Base> createUniqueInstance(const std::string& class_name, const std::string& library_path,
                                                    Arguments&&... arguments) {
    return loader_for(library_path).createUniqueInstance<Base>(class_name, std::forward<Arguments>(arguments)...);
  }
  template <typename Base, typename... Arguments, detail::IfTaken<Base, Arguments...> = true>
  Base* createUnmanagedInstance(const std::string& class_name, const std::string& library_path,
                                Arguments&&... arguments) {
    return loader_for(library_path).createUnmanagedInstance<Base>(class_name, std::forward<Arguments>(arguments)...);
  }

 private:
  ClassLoader& loader_for(const std::string& library_path) const;
  template <typename Base>
  ClassLoader& loader_of(const std::string& class_name) const {
    for (const auto& [path, loader] : loaders_) {
      if (on_demand_ && !loader->isLibraryLoaded()) {
        loader->loadLibrary();
      }
      if (loader->template isClassAvailable<Base>(class_name)) {
        return *loader;
      }
    }
    throw CreateClassException("no library that is loaded has the class '" + class_name + "'");
  }

  const bool on_demand_;
  std::map<std::string, std::unique_ptr<ClassLoader>> loaders_;
};

}  // namespace class_loader
