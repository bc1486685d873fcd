// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/plan/library_search.hpp"

#include <glob.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace tracing {
namespace {

constexpr const char* kLinkerConfiguration = "/etc/ld.so.conf";
constexpr int kDeepestInclude = 8;  // a file that includes itself must end

void append_configuration(const std::string& file, int depth, std::vector<std::string>& directories);

void append_included(const std::string& pattern, const std::string& from, int depth,
                     std::vector<std::string>& directories) {
  const std::filesystem::path absolute = std::filesystem::path(from).parent_path() / pattern;
  glob_t found{};
  if (glob(absolute.c_str(), 0, nullptr, &found) == 0) {
    for (std::size_t i = 0; i < found.gl_pathc; ++i) {
      append_configuration(found.gl_pathv[i], depth, directories);
    }
  }
  globfree(&found);
}

void append_configuration(const std::string& file, int depth, std::vector<std::string>& directories) {
  if (depth > kDeepestInclude) {
    return;
  }
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::string first;
    if (!(words >> first)) {
      continue;
    }
    if (first != "include") {
      directories.push_back(first);
      continue;
    }
    for (std::string pattern; words >> pattern;) {
      append_included(pattern, file, depth + 1, directories);
    }
  }
}

std::vector<std::string> linker_directories() {
  std::vector<std::string> directories;
  if (const char* given = std::getenv("LD_LIBRARY_PATH")) {
    std::istringstream items(given);
    for (std::string item; std::getline(items, item, ':');) {
      if (!item.empty()) {
        directories.push_back(item);
      }
    }
  }
  for (std::string& directory : read_linker_configuration(kLinkerConfiguration)) {
    directories.push_back(std::move(directory));
  }
  for (const char* standard : {"/lib64", "/usr/lib64", "/lib", "/usr/lib"}) {
    directories.emplace_back(standard);
  }
  return directories;
}

}  // namespace

std::vector<std::string> read_linker_configuration(const std::string& file) {
  std::vector<std::string> directories;
  append_configuration(file, 0, directories);
  return directories;
}

std::string find_shared_library(const std::string& file_name) {
  for (const std::string& directory : linker_directories()) {
    const std::filesystem::path path = std::filesystem::path(directory) / file_name;
    std::error_code ignored;
    if (std::filesystem::exists(path, ignored)) {
      return std::filesystem::absolute(path).string();
    }
  }
  return {};
}

}  // namespace tracing
