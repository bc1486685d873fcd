// SPDX-License-Identifier: Apache-2.0
// The exported plugins: their descriptions, and the paths of their libraries.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "pluginlib/class_desc.hpp"

namespace pluginlib::detail {

// Throws ClassLoaderException if the ament index does not know the package.
void require_package(const std::string& package);

// The descriptions of plugins for the package, in all prefixes of AMENT_PREFIX_PATH.
std::vector<std::string> find_descriptions(const std::string& package, const std::string& attribute);

// The plugins with that base class, by lookup name. A file that cannot be read, or is not a description, is reported on
// stderr. Only its own plugins are then missing.
std::map<std::string, ClassDesc> read_plugins(const std::vector<std::string>& files, const std::string& base_class);

// Finds the library: in the prefix of the package, next to the package, or in the folders of the dynamic loader. Throws
// LibraryLoadException with the searched places.
std::string find_library(const ClassDesc& plugin);

}  // namespace pluginlib::detail
