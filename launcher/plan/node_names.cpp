// SPDX-License-Identifier: Apache-2.0
#include "launcher/plan/node_names.hpp"

namespace launch {

std::string joined_name(const std::string& name_space, const std::string& name) {
  const std::string base = name_space.empty() || name_space.front() != '/' ? "/" + name_space : name_space;
  return base == "/" ? "/" + name : base + "/" + name;
}

std::string resolved_name(const std::string& name, const std::string& name_space, const std::string& node) {
  if (name.starts_with('/')) {
    return name;
  }
  if (name == "~" || name.starts_with("~/")) {
    return node + name.substr(1);
  }
  return joined_name(name_space, name);
}

std::vector<std::pair<std::string, std::string>> remaps_of(const std::vector<std::string>& argv) {
  std::vector<std::pair<std::string, std::string>> remaps;
  for (std::size_t i = 1; i < argv.size(); ++i) {
    const std::size_t separator = argv[i].find(":=");
    if ((argv[i - 1] == "-r" || argv[i - 1] == "--remap") && separator != std::string::npos &&
        argv[i].find("__n") == std::string::npos) {
      remaps.emplace_back(argv[i].substr(0, separator), argv[i].substr(separator + 2));
    }
  }
  return remaps;
}

}  // namespace launch
