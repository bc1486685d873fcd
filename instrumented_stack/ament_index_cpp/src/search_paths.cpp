// SPDX-License-Identifier: Apache-2.0
#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <system_error>

#include "ament_index_cpp/get_search_paths.hpp"

namespace ament_index_cpp {

namespace {

namespace fs = std::filesystem;

bool exists_as_directory(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

// PREFIX in PREFIX/lib/libament_index_cpp.so, which may have been moved. Empty if the library is in another folder.
std::string own_prefix() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&own_prefix), &info) == 0 || info.dli_fname == nullptr) {
    return {};
  }
  std::error_code error;
  const fs::path library = fs::canonical(info.dli_fname, error);
  const fs::path prefix = library.parent_path().parent_path();
  return !error && exists_as_directory(prefix / "share/ament_index") ? prefix.string() : std::string();
}

}  // namespace

std::list<std::string> get_search_paths() {
  std::list<std::string> paths;
  const char* variable = std::getenv("AMENT_PREFIX_PATH");
  std::istringstream entries(variable != nullptr ? variable : "");
  for (std::string entry; std::getline(entries, entry, ':');) {
    if (!entry.empty() && exists_as_directory(entry)) {
      paths.push_back(entry);
    }
  }
  static const std::string own = own_prefix();
  if (!own.empty()) {
    paths.push_back(own);
  }
  return paths;
}

}  // namespace ament_index_cpp
