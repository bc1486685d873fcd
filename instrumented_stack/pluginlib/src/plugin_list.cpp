// SPDX-License-Identifier: Apache-2.0
#include "pluginlib/detail/plugin_list.hpp"

#include <tinyxml2.h>

#include <ament_index_cpp/get_package_prefix.hpp>
#include <ament_index_cpp/get_resource.hpp>
#include <ament_index_cpp/get_resources.hpp>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include "pluginlib/exceptions.hpp"

namespace pluginlib::detail {

namespace {

namespace fs = std::filesystem;
using tinyxml2::XMLElement;

constexpr const char* kUnresolved = "UNRESOLVED";

std::string attribute_of(const XMLElement& element, const char* name) {
  const char* const value = element.Attribute(name);
  return value == nullptr ? "" : value;
}

std::string required_attribute(const XMLElement& element, const char* name) {
  const std::string value = attribute_of(element, name);
  if (value.empty()) {
    throw InvalidXMLException("line " + std::to_string(element.GetLineNum()) + ": <" + element.Name() +
                              "> needs the attribute '" + name + "'");
  }
  return value;
}

std::string trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(" \t\r\n");
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(" \t\r\n") - begin + 1);
}

// The package whose share folder contains the file, or the one with the nearest package.xml.
std::string package_of(const fs::path& file) {
  for (fs::path folder = file.parent_path(); folder.has_relative_path(); folder = folder.parent_path()) {
    tinyxml2::XMLDocument document;
    const fs::path manifest = folder / "package.xml";
    if (fs::exists(manifest) && document.LoadFile(manifest.c_str()) == tinyxml2::XML_SUCCESS) {
      const XMLElement* const package = document.FirstChildElement("package");
      const XMLElement* const name = package == nullptr ? nullptr : package->FirstChildElement("name");
      return name == nullptr || name->GetText() == nullptr ? "" : trimmed(name->GetText());
    }
    if (folder.parent_path().filename() == "share") {
      return folder.filename().string();
    }
  }
  return "";
}

void read_class(const XMLElement& element, const std::string& library, const std::string& file,
                const std::string& base_class, std::map<std::string, ClassDesc>& plugins) {
  ClassDesc plugin;
  plugin.derived_class_ = required_attribute(element, "type");
  plugin.base_class_ = required_attribute(element, "base_class_type");
  plugin.lookup_name_ = attribute_of(element, "name");
  if (plugin.base_class_ != base_class) {
    return;
  }
  if (plugin.lookup_name_.empty()) {
    plugin.lookup_name_ = plugin.derived_class_;
  }
  plugin.package_ = package_of(file);
  if (const XMLElement* const description = element.FirstChildElement("description");
      description != nullptr && description->GetText() != nullptr) {
    plugin.description_ = trimmed(description->GetText());
  }
  plugin.library_name_ = library;
  plugin.resolved_library_path_ = kUnresolved;
  plugin.plugin_manifest_path_ = file;
  plugins.emplace(plugin.lookup_name_, plugin);
}

void read_file(const std::string& file, const std::string& base_class, std::map<std::string, ClassDesc>& plugins) {
  tinyxml2::XMLDocument document;
  if (document.LoadFile(file.c_str()) != tinyxml2::XML_SUCCESS) {
    throw InvalidXMLException(document.ErrorStr());
  }
  const XMLElement* const root = document.RootElement();
  const std::string kind = root->Name();
  if (kind != "library" && kind != "class_libraries") {
    throw InvalidXMLException("line " + std::to_string(root->GetLineNum()) + ": <" + kind +
                              "> must be <library> or <class_libraries>");
  }
  const XMLElement* library = kind == "library" ? root : root->FirstChildElement("library");
  while (library != nullptr) {
    const std::string path = required_attribute(*library, "path");
    for (const XMLElement* element = library->FirstChildElement("class"); element != nullptr;
         element = element->NextSiblingElement("class")) {
      read_class(*element, path, file, base_class, plugins);
    }
    library = library == root ? nullptr : library->NextSiblingElement("library");
  }
}

}  // namespace

void require_package(const std::string& package) {
  try {
    (void)ament_index_cpp::get_package_prefix(package);
  } catch (const ament_index_cpp::PackageNotFoundError&) {
    throw ClassLoaderException("the package '" + package + "' is in no prefix of AMENT_PREFIX_PATH");
  }
}

std::vector<std::string> find_descriptions(const std::string& package, const std::string& attribute) {
  std::vector<std::string> files;
  const std::string type = package + "__pluginlib__" + attribute;
  for (const auto& [exporter, prefix] : ament_index_cpp::get_resources(type)) {
    std::string content;
    std::string found_in;
    if (!ament_index_cpp::get_resource(type, exporter, content, &found_in)) {
      continue;
    }
    std::istringstream lines(content);
    for (std::string line; std::getline(lines, line);) {
      if (const std::string file = trimmed(line); !file.empty()) {
        files.push_back((fs::path(found_in) / file).string());
      }
    }
  }
  return files;
}

std::map<std::string, ClassDesc> read_plugins(const std::vector<std::string>& files, const std::string& base_class) {
  std::map<std::string, ClassDesc> plugins;
  for (const std::string& file : files) {
    try {
      read_file(file, base_class, plugins);
    } catch (const InvalidXMLException& error) {
      std::fprintf(stderr, "pluginlib: the plugins of %s are left out: %s\n", file.c_str(), error.what());
    }
  }
  return plugins;
}

std::string find_library(const ClassDesc& plugin) {
  // Descriptions may name a library as in CMake, as a file, or with a folder: shapes, libshapes, lib/libshapes.so.
  const fs::path named(plugin.library_name_);
  std::vector<fs::path> names;
  const std::string stem = named.filename().string();
  for (const std::string& file : {stem, stem + ".so", "lib" + stem + ".so"}) {
    names.push_back(named.parent_path() / file);
  }
  std::vector<fs::path> folders;
  try {
    const fs::path prefix = ament_index_cpp::get_package_prefix(plugin.package_);
    folders = {prefix / "lib", prefix / "lib" / plugin.package_, prefix};
  } catch (const std::exception&) {
    // A description that was given by its path may belong to no package.
  }
  folders.push_back(fs::path(plugin.plugin_manifest_path_).parent_path());
  std::string places;
  for (const fs::path& folder : folders) {
    for (const fs::path& name : names) {
      if (const fs::path file = folder / name; fs::is_regular_file(file)) {
        return file.string();
      }
    }
    places += "\n  " + folder.string();
  }
  throw LibraryLoadException("the library '" + plugin.library_name_ + "' of plugin '" + plugin.lookup_name_ +
                             "' is in none of:" + places);
}

}  // namespace pluginlib::detail
