// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/lsp/python_names.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/environment/own_prefix.hpp"

namespace launch::lsp {

namespace {

using Json = nlohmann::json;

PythonName read_name(const Json& entry) {
  PythonName name;
  name.kind = entry.value("kind", "");
  name.help = entry.value("help", "");
  name.tag = entry.value("tag", "");
  name.complete = entry.value("complete", false);
  for (const Json& argument : entry.value("arguments", Json::array())) {
    name.arguments.push_back(
        {argument.value("name", ""), argument.value("required", false), argument.value("positional", false)});
  }
  return name;
}

}  // namespace

const PythonNames& PythonNames::of_installation() {
  static const PythonNames names = [] {
    PythonNames read;
    std::ifstream file(own_library_file("python_names.json"));
    const Json table = Json::parse(file, nullptr, false);
    if (table.is_object()) {
      for (const auto& [module, entries] : table.items()) {
        Module& known = read.modules_[module];
        for (const auto& [name, entry] : entries.items()) {
          known.emplace(name, read_name(entry));
        }
      }
    }
    return read;
  }();
  return names;
}

const PythonNames::Module* PythonNames::module(std::string_view name) const {
  const auto found = modules_.find(std::string(name));
  return found == modules_.end() ? nullptr : &found->second;
}

const PythonName* PythonNames::find(std::string_view full_name) const {
  const std::size_t dot = full_name.rfind('.');
  if (dot == std::string_view::npos) {
    return nullptr;
  }
  const Module* const in = module(full_name.substr(0, dot));
  const auto found = in == nullptr ? Module::const_iterator() : in->find(std::string(full_name.substr(dot + 1)));
  return in == nullptr || found == in->end() ? nullptr : &found->second;
}

std::vector<std::string> PythonNames::homes_of(std::string_view name) const {
  std::vector<std::string> homes;
  for (const auto& [module, entries] : modules_) {
    if (entries.contains(std::string(name))) {
      homes.push_back(module);
    }
  }
  // `launch.actions` rather than a module for one class, `ament_index_python.packages` rather than its package.
  const auto rank = [](const std::string& module) {
    constexpr std::string_view kUsual[] = {"launch.actions",
                                           "launch.substitutions",
                                           "launch.conditions",
                                           "launch.event_handlers",
                                           "launch.launch_description_sources",
                                           "launch_ros.actions",
                                           "launch_ros.substitutions",
                                           "launch_ros.descriptions",
                                           "launch",
                                           "ament_index_python.packages"};
    return std::find(std::begin(kUsual), std::end(kUsual), module) - std::begin(kUsual);
  };
  std::stable_sort(homes.begin(), homes.end(),
                   [&](const std::string& one, const std::string& other) { return rank(one) < rank(other); });
  return homes;
}

}  // namespace launch::lsp
