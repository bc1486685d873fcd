// SPDX-License-Identifier: Apache-2.0
// Finds the folder of a package's files other than programs and libraries.
#pragma once

#include <filesystem>
#include <string>

#include "ament_index_cpp/get_package_prefix.hpp"

namespace ament_index_cpp {

// PREFIX/share/PACKAGE. Throw as get_package_prefix() does.
std::string get_package_share_directory(const std::string& package_name);
std::filesystem::path get_package_share_path(const std::string& package_name);

}  // namespace ament_index_cpp
