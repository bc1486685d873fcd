// SPDX-License-Identifier: Apache-2.0
// Creates objects of the plugins that packages export for a base class.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "class_loader/multi_library_class_loader.hpp"
#include "pluginlib/class_desc.hpp"
#include "pluginlib/class_list_macros.hpp"
#include "pluginlib/detail/plugin_list.hpp"
#include "pluginlib/exceptions.hpp"

namespace pluginlib {

template <typename T>
using UniquePtr = class_loader::ClassLoader::UniquePtr<T>;

class ClassLoaderBase {
 public:
  virtual ~ClassLoaderBase() = default;

  virtual std::vector<std::string> getPluginXmlPaths() = 0;
  virtual std::vector<std::string> getDeclaredClasses() = 0;
  virtual std::string getBaseClassType() const = 0;
  virtual std::string getName(const std::string& lookup_name) = 0;
  virtual std::string getClassType(const std::string& lookup_name) = 0;
  virtual std::string getClassDescription(const std::string& lookup_name) = 0;
  virtual std::string getClassLibraryPath(const std::string& lookup_name) = 0;
  virtual std::string getClassPackage(const std::string& lookup_name) = 0;
  virtual std::string getPluginManifestPath(const std::string& lookup_name) = 0;
  virtual bool isClassAvailable(const std::string& lookup_name) = 0;
  virtual bool isClassLoaded(const std::string& lookup_name) = 0;
  virtual void loadLibraryForClass(const std::string& lookup_name) = 0;
  virtual int unloadLibraryForClass(const std::string& lookup_name) = 0;
  virtual std::vector<std::string> getRegisteredLibraries() = 0;
  virtual void refreshDeclaredClasses() = 0;
};

// Functions that take the name of a plugin throw LibraryLoadException if no package exports it or its library cannot be
// loaded. Not thread safe.
template <typename T>
class ClassLoader : public ClassLoaderBase {
 public:
  using UniquePtr = pluginlib::UniquePtr<T>;

  // `base_class` is written as in the descriptions. If `plugin_xml_paths` are given, they replace the descriptions in
  // the ament index. Throws ClassLoaderException if the package is not found.
  ClassLoader(std::string package, std::string base_class, std::string attrib_name = std::string("plugin"),
              std::vector<std::string> plugin_xml_paths = std::vector<std::string>())
      : package_(std::move(package)),
        base_class_(std::move(base_class)),
        attribute_(std::move(attrib_name)),
        files_(std::move(plugin_xml_paths)) {
    detail::require_package(package_);
    if (files_.empty()) {
      files_ = detail::find_descriptions(package_, attribute_);
    }
    plugins_ = detail::read_plugins(files_, base_class_);
  }

  // Load the library if needed. Objects keep it loaded; it is unloaded with the loader and the last object. `arguments`
  // go to the constructor: see class_loader/interface_traits.hpp. Throw CreateClassException if the library has no such
  // class.
  template <typename... Arguments>
  std::shared_ptr<T> createSharedInstance(const std::string& lookup_name, Arguments&&... arguments) {
    return createUniqueInstance(lookup_name, std::forward<Arguments>(arguments)...);
  }
  template <typename... Arguments>
  UniquePtr createUniqueInstance(const std::string& lookup_name, Arguments&&... arguments) {
    return create(lookup_name, [&](const std::string& class_name, const std::string& library) {
      return loader_.createUniqueInstance<T>(class_name, library, std::forward<Arguments>(arguments)...);
    });
  }
  // The caller deletes the object. The library then stays loaded until the process ends.
  template <typename... Arguments>
  T* createUnmanagedInstance(const std::string& lookup_name, Arguments&&... arguments) {
    return create(lookup_name, [&](const std::string& class_name, const std::string& library) {
      return loader_.createUnmanagedInstance<T>(class_name, library, std::forward<Arguments>(arguments)...);
    });
  }

  std::vector<std::string> getPluginXmlPaths() override { return files_; }
  std::vector<std::string> getDeclaredClasses() override {
    std::vector<std::string> names;
    for (const auto& [name, plugin] : plugins_) {
      names.push_back(name);
    }
    return names;
  }
  std::string getBaseClassType() const override { return base_class_; }
  // The part after the last '/' or ':'.
  std::string getName(const std::string& lookup_name) override {
    return lookup_name.substr(lookup_name.find_last_of("/:") + 1);
  }
  // Empty if no package exports the plugin; so are the following functions.
  std::string getClassType(const std::string& lookup_name) override {
    return told_of(lookup_name, &ClassDesc::derived_class_);
  }
  std::string getClassDescription(const std::string& lookup_name) override {
    return told_of(lookup_name, &ClassDesc::description_);
  }
  std::string getClassPackage(const std::string& lookup_name) override {
    return told_of(lookup_name, &ClassDesc::package_);
  }
  std::string getPluginManifestPath(const std::string& lookup_name) override {
    return told_of(lookup_name, &ClassDesc::plugin_manifest_path_);
  }
  // The path of the library.
  std::string getClassLibraryPath(const std::string& lookup_name) override {
    return detail::find_library(plugin(lookup_name));
  }

  bool isClassAvailable(const std::string& lookup_name) override { return plugins_.count(lookup_name) != 0; }
  bool isClassLoaded(const std::string& lookup_name) override {
    const auto found = plugins_.find(lookup_name);
    return found != plugins_.end() && loader_.isLibraryAvailable(found->second.resolved_library_path_);
  }
  void loadLibraryForClass(const std::string& lookup_name) override {
    ClassDesc& wanted = plugin(lookup_name);
    wanted.resolved_library_path_ = detail::find_library(wanted);
    try {
      loader_.loadLibrary(wanted.resolved_library_path_);
    } catch (const class_loader::LibraryLoadException& error) {
      throw LibraryLoadException("failed to load the library of plugin '" + lookup_name + "': " + error.what());
    }
  }
  // Returns how many calls are still needed: 0. Throws LibraryUnloadException if the library is not loaded.
  int unloadLibraryForClass(const std::string& lookup_name) override {
    try {
      return loader_.unloadLibrary(plugin(lookup_name).resolved_library_path_);
    } catch (const class_loader::LibraryUnloadException&) {
      throw LibraryUnloadException("the library of plugin '" + lookup_name + "' is not loaded");
    }
  }
  std::vector<std::string> getRegisteredLibraries() override { return loader_.getRegisteredLibraries(); }

  // Finds new plugins; loaded libraries stay loaded.
  void refreshDeclaredClasses() override {
    files_ = detail::find_descriptions(package_, attribute_);
    std::map<std::string, ClassDesc> found = detail::read_plugins(files_, base_class_);
    for (auto& [name, refreshed] : found) {
      if (isClassLoaded(name)) {
        refreshed = plugins_.at(name);
      }
    }
    plugins_ = std::move(found);
  }

 private:
  ClassDesc& plugin(const std::string& lookup_name) {
    const auto found = plugins_.find(lookup_name);
    if (found != plugins_.end()) {
      return found->second;
    }
    std::string message =
        "no package exports a plugin '" + lookup_name + "' with base class '" + base_class_ + "'; there are:";
    for (const auto& [name, exported] : plugins_) {
      message += " '" + name + "'";
    }
    throw LibraryLoadException(plugins_.empty() ? message + " none" : message);
  }
  std::string told_of(const std::string& lookup_name, std::string ClassDesc::*what) const {
    const auto found = plugins_.find(lookup_name);
    return found == plugins_.end() ? "" : found->second.*what;
  }
  template <typename CreateT>
  auto create(const std::string& lookup_name, CreateT create_from) {
    if (!isClassLoaded(lookup_name)) {
      loadLibraryForClass(lookup_name);
    }
    const ClassDesc& wanted = plugin(lookup_name);
    try {
      return create_from(wanted.derived_class_, wanted.resolved_library_path_);
    } catch (const class_loader::CreateClassException& error) {
      throw CreateClassException(error.what());
    }
  }

  const std::string package_;
  const std::string base_class_;
  const std::string attribute_;
  std::vector<std::string> files_;
  std::map<std::string, ClassDesc> plugins_;
  class_loader::MultiLibraryClassLoader loader_{false};
};

}  // namespace pluginlib
