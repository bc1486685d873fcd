// SPDX-License-Identifier: Apache-2.0
#include "class_loader/multi_library_class_loader.hpp"

namespace class_loader {

void MultiLibraryClassLoader::loadLibrary(const std::string& library_path) {
  if (!isLibraryAvailable(library_path)) {
    loaders_.emplace(library_path, std::make_unique<ClassLoader>(library_path, on_demand_));
  }
}

int MultiLibraryClassLoader::unloadLibrary(const std::string& library_path) {
  const auto found = loaders_.find(library_path);
  if (found == loaders_.end()) {
    throw LibraryUnloadException("the library '" + library_path + "' is not loaded");
  }
  const int left = found->second->unloadLibrary();
  if (left == 0) {
    loaders_.erase(found);
  }
  return left;
}

std::vector<std::string> MultiLibraryClassLoader::getRegisteredLibraries() const {
  std::vector<std::string> libraries;
  for (const auto& [path, loader] : loaders_) {
    libraries.push_back(path);
  }
  return libraries;
}

ClassLoader& MultiLibraryClassLoader::loader_for(const std::string& library_path) const {
  const auto found = loaders_.find(library_path);
  if (found == loaders_.end()) {
    throw NoClassLoaderExistsException("the library '" + library_path + "' is not loaded");
  }
  return *found->second;
}

}  // namespace class_loader
