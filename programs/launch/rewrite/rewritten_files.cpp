// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/rewrite/rewritten_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "base/diagnostics/diagnostic.hpp"
#include "base/files/replace_file.hpp"
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

void rewrite_file(const std::string& path, const std::string& text) {
  try {
    const fs::path target = fs::canonical(path);
    const fs::perms permissions = fs::status(target).permissions();
    replace_file(target.string(), text);
    fs::permissions(target, permissions);
  } catch (const std::system_error& error) {
    throw LaunchError(fmt::format("'{}' can't be written: {}", path, error.code().message()), {}, {},
                      Finding::kUnreadableFile);
  }
}

}  // namespace launch
