// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/spawn/program_search.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string_view>
#include <system_error>

#include "base/files/unique_fd.hpp"

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

namespace {

// The interpreter named by the first line of a script; empty for another file.
std::string script_interpreter(const std::string& path) {
  const UniqueFd file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  std::array<char, 256> buffer{};  // the kernel reads no more either
  const ssize_t size = file ? ::read(file.get(), buffer.data(), buffer.size()) : -1;
  std::string_view text(buffer.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
  if (!text.starts_with("#!")) {
    return {};
  }
  text.remove_prefix(2);
  text = text.substr(0, text.find('\n'));
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) {
    return {};
  }
  text.remove_prefix(begin);
  return std::string(text.substr(0, text.find_first_of(" \t")));
}

std::string directory_problem(const std::string& directory) {
  struct stat status {};
  if (::stat(directory.c_str(), &status) != 0) {
    return fmt::format("cannot enter the working directory '{}'", directory);
  }
  if (!S_ISDIR(status.st_mode)) {
    return fmt::format("the working directory '{}' is not a directory", directory);
  }
  if (::access(directory.c_str(), X_OK) != 0) {
    return fmt::format("cannot enter the working directory '{}'", directory);
  }
  return {};
}

std::string program_problem(int error, const std::string& program, const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    return fmt::format("cannot find the program '{}'", program);
  }
  if (S_ISDIR(status.st_mode)) {
    return fmt::format("the program '{}' is a directory", program);
  }
  if (::access(path.c_str(), X_OK) != 0) {
    return fmt::format("'{}' is not executable (chmod +x makes it so)", program);
  }
  const std::string interpreter = script_interpreter(path);
  if (error == ENOEXEC) {
    return fmt::format("'{}' is neither a program for this machine nor a script with a #! line", program);
  }
  if (!interpreter.empty()) {
    return fmt::format("cannot run '{}', the interpreter of the script '{}'", interpreter, program);
  }
  if (error == ENOENT) {
    return fmt::format("cannot find the dynamic loader that the program '{}' asks for", program);
  }
  return fmt::format("cannot run the program '{}'", program);
}

}  // namespace

std::system_error spawn_failure(int error, const ProcessSpec& spec, const std::string& program) {
  std::string problem;
  if (error == EAGAIN || error == ENOMEM || error == EMFILE || error == ENFILE) {
    problem = "cannot create a process";
  } else if (error == E2BIG) {
    problem = fmt::format("the arguments and the environment of '{}' are too long", program);
  } else {
    if (!spec.working_directory.empty()) {
      problem = directory_problem(spec.working_directory);
    }
    if (problem.empty()) {
      const bool from_here = program.starts_with('/') || spec.working_directory.empty();
      problem = program_problem(error, program, from_here ? program : spec.working_directory + "/" + program);
    }
  }
  return {error, std::system_category(), problem};
}

}  // namespace launch
