// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/rewrite/replace_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/invocation/find_launch_file.hpp"

namespace launch {

namespace fs = std::filesystem;

std::vector<std::string> launch_files_in(const std::vector<std::string>& words) {
  std::vector<std::string> files;
  for (const std::string& word : words) {
    std::error_code unreadable;
    if (!fs::is_directory(word, unreadable)) {
      files.push_back(word);
      continue;
    }
    const auto first = static_cast<std::ptrdiff_t>(files.size());
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(word, unreadable)) {
      if (is_launch_file(entry.path()) && entry.path().extension() != ".py" && entry.is_regular_file(unreadable)) {
        files.push_back(entry.path().string());
      }
    }
    std::sort(files.begin() + first, files.end());
  }
  return files;
}

void replace_file(const std::string& path, const std::string& text) {
  const auto failed = [&](const std::string& reason) {
    throw LaunchError(fmt::format("'{}' can't be written: {}", path, reason), {}, {}, Finding::kUnreadableFile);
  };
  std::error_code error;
  const fs::path target = fs::canonical(path, error);  // a link stays one
  if (error) {
    failed(error.message());
  }
  const fs::path fresh = target.parent_path() / ("." + target.filename().string() + ".new");
  {
    std::ofstream file(fresh, std::ios::binary);
    file << text;
    file.close();
    if (!file) {
      fs::remove(fresh, error);
      failed("no space, or no permission in its directory");
    }
  }
  fs::permissions(fresh, fs::status(target).permissions(), error);
  fs::rename(fresh, target, error);
  if (error) {
    const std::string reason = error.message();
    fs::remove(fresh, error);
    failed(reason);
  }
}

}  // namespace launch
