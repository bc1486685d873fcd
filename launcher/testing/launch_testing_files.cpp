// SPDX-License-Identifier: Apache-2.0
#include "launcher/testing/launch_testing_files.hpp"

#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>

#include "base/environment/own_prefix.hpp"

namespace launch {

bool is_launch_testing_file(const std::string& path) {
  if (!path.ends_with(".py")) {
    return false;
  }
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  return text.find("def generate_test_description") != std::string::npos;
}

void run_launch_testing_files(const std::vector<std::string>& files, const LaunchArguments& arguments,
                              const std::string& junit) {
  std::vector<std::string> words = {own_prefix() + "/bin/launch_test"};
  words.insert(words.end(), files.begin(), files.end());
  for (const auto& [name, value] : arguments) {
    words.push_back(name + ":=" + value);
  }
  if (!junit.empty()) {
    words.push_back("--junit-xml=" + junit);
  }
  std::vector<char*> argv;
  for (std::string& word : words) {
    argv.push_back(word.data());
  }
  argv.push_back(nullptr);
  ::execv(argv.front(), argv.data());
  throw std::system_error(errno, std::system_category(), "cannot run '" + words.front() + "'");
}

}  // namespace launch
