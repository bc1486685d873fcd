#include "launcher/cli/find_launch_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "launcher/base/diagnostic.hpp"
#include "launcher/substitution/package_index.hpp"

namespace launch {

namespace fs = std::filesystem;

namespace {

std::string find_in_package(const std::string& package, const std::string& name, const Scope& scope) {
  std::string share;
  try {
    share = scope.packages->share(package, scope.environment);
  } catch (const std::runtime_error& error) {
    throw LaunchError(error.what(), {}, did_you_mean(package, scope.packages->packages(scope.environment)));
  }
  std::vector<std::string> found;
  std::vector<std::string> names;
  std::error_code unreadable;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(share, unreadable)) {
    if (!entry.is_regular_file()) {
      continue;
    }
    names.push_back(entry.path().filename().string());
    if (names.back() == name) {
      found.push_back(entry.path().string());
    }
  }
  if (found.empty()) {
    throw LaunchError(fmt::format("file '{}' was not found in the share directory of package '{}' which is at '{}'",
                                  name, package, share),
                      {}, did_you_mean(name, names));
  }
  if (found.size() > 1) {
    std::sort(found.begin(), found.end());
    throw LaunchError(fmt::format("file '{}' was found more than once in the share directory of package '{}': ['{}']",
                                  name, package, fmt::join(found, "', '")),
                      {}, "give the path of the one you mean");
  }
  return found.front();
}

}  // namespace

std::string find_launch_file(const std::vector<std::string>& words, const Scope& scope) {
  std::error_code ignored;
  if (fs::exists(words.front(), ignored) && !fs::is_directory(words.front(), ignored)) {
    if (words.size() > 1) {
      throw LaunchError(fmt::format("malformed launch argument '{}', expected format '<name>:=<value>'", words[1]), {});
    }
    return words.front();
  }
  if (words.size() == 1) {
    throw LaunchError(fmt::format("launch file '{}' does not exist", words.front()), {},
                      "a file of a package is named by two words: launch PACKAGE FILE");
  }
  return find_in_package(words[0], words[1], scope);
}

}  // namespace launch
