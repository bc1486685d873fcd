// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/deploy/exported_files.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>
#include <system_error>
#include <vector>

namespace launch {
namespace {

namespace fs = std::filesystem;

bool has_mark(const fs::path& path, const std::string& mark) {
  std::ifstream file(path);
  std::string line;
  return std::getline(file, line) && line == mark;
}

// The folders in which an export of this name may have left files: parameter files are in folders of their own.
std::vector<fs::path> folders_of(const Deployment& deployment, const fs::path& directory) {
  std::set<fs::path> folders = {directory};
  for (const DeployedFile& file : deployment.files) {
    folders.insert((directory / file.path).parent_path());
  }
  return {folders.begin(), folders.end()};
}

}  // namespace

void write_exported_files(const Deployment& deployment, const DeploymentOptions& options) {
  const fs::path directory = options.directory;
  const std::string mark = export_mark(options);
  std::set<fs::path> written;
  for (const DeployedFile& file : deployment.files) {
    const fs::path path = directory / file.path;
    if (fs::exists(path) && !has_mark(path, mark)) {
      throw std::runtime_error(fmt::format(
          "'{}' is there, and no export with the name '{}' has made it; choose another --name or another place",
          path.string(), options.name));
    }
    written.insert(path);
  }
  for (const fs::path& folder : folders_of(deployment, directory)) {
    if (!fs::exists(folder)) {
      continue;
    }
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
      if (entry.is_regular_file() && !written.contains(entry.path()) && has_mark(entry.path(), mark)) {
        fs::remove(entry.path());
      }
    }
  }
  for (const DeployedFile& file : deployment.files) {
    const fs::path path = directory / file.path;
    fs::create_directories(path.parent_path());
    if (std::ofstream out(path); !(out << file.content).flush()) {
      throw std::runtime_error(fmt::format("'{}' can't be written", path.string()));
    }
  }
}

}  // namespace launch
