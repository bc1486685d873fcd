// SPDX-License-Identifier: Apache-2.0
// The plugins that packages export: their descriptions, and where their libraries are.
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

// The plugins with that base class, by lookup name. A file that cannot be read, or that is no description, is reported
// on stderr and costs its plugins only.
std::map<std::string, ClassDesc> read_plugins(const std::vector<std::string>& files, const std::string& base_class);

// Where the library is: in the prefix of the package, next to it, or where the dynamic loader looks. Throws
// LibraryLoadException with the places.
std::string find_library(const ClassDesc& plugin);

}  // namespace pluginlib::detail
