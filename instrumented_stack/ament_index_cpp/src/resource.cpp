// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

#include "ament_index_cpp/get_resource.hpp"
#include "ament_index_cpp/get_resources.hpp"
#include "ament_index_cpp/get_search_paths.hpp"
#include "ament_index_cpp/has_resource.hpp"

namespace ament_index_cpp {

namespace {

namespace fs = std::filesystem;

fs::path index_folder(const std::string& prefix, const std::string& resource_type) {
  return fs::path(prefix) / "share/ament_index/resource_index" / resource_type;
}

void require_type(const std::string& resource_type) {
  if (resource_type.empty()) {
    throw std::runtime_error("ament_index_cpp: the resource type must not be empty");
  }
}

}  // namespace

bool has_resource(const std::string& resource_type, const std::string& resource_name, std::string* prefix_path) {
  require_type(resource_type);
  if (resource_name.empty()) {
    throw std::runtime_error("ament_index_cpp: the resource name must not be empty");
  }
  if (resource_name.find('/') != std::string::npos) {
    return false;  // it would lead out of the index
  }
  for (const std::string& prefix : get_search_paths()) {
    std::error_code error;
    if (fs::is_regular_file(index_folder(prefix, resource_type) / resource_name, error)) {
      if (prefix_path != nullptr) {
        *prefix_path = prefix;
      }
      return true;
    }
  }
  return false;
}

bool get_resource(const std::string& resource_type, const std::string& resource_name, std::string& content,
                  std::string* prefix_path) {
  std::string prefix;
  if (!has_resource(resource_type, resource_name, &prefix)) {
    return false;
  }
  const fs::path path = index_folder(prefix, resource_type) / resource_name;
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw std::runtime_error("ament_index_cpp: cannot read " + path.string());
  }
  content.assign(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  if (prefix_path != nullptr) {
    *prefix_path = prefix;
  }
  return true;
}

std::map<std::string, std::string> get_resources(const std::string& resource_type) {
  require_type(resource_type);
  std::map<std::string, std::string> resources;
  for (const std::string& prefix : get_search_paths()) {
    std::error_code error;
    for (fs::directory_iterator entry(index_folder(prefix, resource_type), error), end; !error && entry != end;
         entry.increment(error)) {
      const std::string name = entry->path().filename().string();
      // Hidden files are not resources.
      if (name.front() != '.' && entry->is_regular_file(error)) {
        resources.emplace(name, prefix);
      }
    }
  }
  return resources;
}

}  // namespace ament_index_cpp
