// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/spawn/program_search.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace launch {
namespace {

// The default of execvp(3) and Python when PATH is not set.
constexpr const char* kDefaultPath = "/bin:/usr/bin";

bool is_program(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) && ::access(path.c_str(), X_OK) == 0;
}

bool is_file(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode);
}

}  // namespace

std::string find_program(const ProcessSpec& spec) {
  const std::string& name = spec.argv.front();
  if (name.find('/') != std::string::npos) {
    return name;
  }
  const auto variable = spec.environment.find("PATH");
  const std::string search = variable == spec.environment.end() ? kDefaultPath : variable->second;
  std::string not_executable;
  for (std::size_t begin = 0; !name.empty() && begin <= search.size();) {
    const std::size_t end = std::min(search.find(':', begin), search.size());
    std::string directory = search.substr(begin, end - begin);
    begin = end + 1;
    if (directory.empty()) {
      directory = ".";
    }
    // The child changes its directory before it executes the program. The path has to be right from there, but the
    // check has to be made from here.
    const std::string there = directory + "/" + name;
    const bool from_here = there.front() == '/' || spec.working_directory.empty();
    const std::string here = from_here ? there : spec.working_directory + "/" + there;
    if (is_program(here)) {
      return there;
    }
    if (not_executable.empty() && is_file(here)) {
      not_executable = here;
    }
  }
  if (!not_executable.empty()) {
    throw std::system_error(EACCES, std::system_category(), fmt::format("'{}' is not executable", not_executable));
  }
  throw std::system_error(ENOENT, std::system_category(),
                          fmt::format("no program '{}' in the PATH of the process", name));
}

}  // namespace launch
