// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/deploy/exported_files.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>
#include <system_error>

#include "launcher/deploy/systemd_text.hpp"

namespace launch {
namespace {

namespace fs = std::filesystem;

bool has_mark(const fs::path& path, const std::string& mark) {
  std::ifstream file(path);
  std::string line;
  return std::getline(file, line) && line == mark;
}

// The files in a folder, and in those for parameter files in it, that an earlier export has left.
std::set<fs::path> files_with_mark(const fs::path& folder, const DeploymentOptions& options) {
  std::set<fs::path> files;
  const std::string mark = export_mark(options);
  const fs::path parameters = folder / "parameters";
  for (const fs::path& place : {folder, parameters, parameters / unit_name(options.name)}) {
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(place, error)) {
      if (entry.is_regular_file(error) && has_mark(entry.path(), mark)) {
        files.insert(entry.path());
      }
    }
  }
  return files;
}

// Those of this machine, and in the folders of other machines.
std::set<fs::path> earlier_files(const fs::path& directory, DeploymentOptions options) {
  std::set<fs::path> files = files_with_mark(directory, options);
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory, error)) {
    if (entry.is_directory(error)) {
      options.machine = entry.path().filename();
      files.merge(files_with_mark(entry.path(), options));
    }
  }
  return files;
}

}  // namespace

void write_exported_files(const Deployment& deployment, const DeploymentOptions& options) {
  const fs::path directory = options.directory;
  std::set<fs::path> old = earlier_files(directory, options);
  for (const DeployedFile& file : deployment.files) {
    const fs::path path = directory / file.path;
    if (fs::exists(path) && !old.contains(path)) {
      throw std::runtime_error(fmt::format(
          "'{}' is there, and no export with the name '{}' has made it; choose another --name or another place",
          path.string(), options.name));
    }
    old.erase(path);
  }
  for (const fs::path& path : old) {
    fs::remove(path);
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
