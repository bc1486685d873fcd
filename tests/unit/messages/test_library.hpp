// SPDX-License-Identifier: Apache-2.0
// The interfaces of the tests and of the stack in a prefix.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/message_types/interface_library.hpp"
#include "launcher/message_types/read_value.hpp"

class TestLibrary {
 public:
  TestLibrary() : prefix_(std::filesystem::temp_directory_path() / ("messages_test_" + std::to_string(::getpid()))) {
    std::filesystem::remove_all(prefix_);
    add("test_interfaces", TEST_INTERFACES);
    for (const auto& entry : std::filesystem::directory_iterator(STACK_INTERFACES)) {
      if (entry.is_directory()) {
        add(entry.path().filename().string(), entry.path());
      }
    }
  }
  ~TestLibrary() { std::filesystem::remove_all(prefix_); }
  TestLibrary(const TestLibrary&) = delete;
  TestLibrary& operator=(const TestLibrary&) = delete;

  launch::InterfaceLibrary make() const { return {launch::PackageIndex(), {{"AMENT_PREFIX_PATH", prefix_.string()}}}; }
  const std::filesystem::path& prefix() const { return prefix_; }

  // A package with one file, for instance "msg/A.msg".
  void add_file(const std::string& package, const std::string& file, const std::string& text) const {
    const std::filesystem::path path = prefix_ / "share" / package / file;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << text;
    mark(package);
  }

 private:
  void add(const std::string& package, const std::filesystem::path& folder) const {
    std::filesystem::create_directories(prefix_ / "share");
    std::filesystem::create_directory_symlink(folder, prefix_ / "share" / package);
    mark(package);
  }
  void mark(const std::string& package) const {
    const std::filesystem::path markers = prefix_ / "share/ament_index/resource_index/packages";
    std::filesystem::create_directories(markers);
    std::ofstream(markers / package);
  }

  std::filesystem::path prefix_;
};

inline launch::LocatedText located(const std::string& text, const std::string& name = "values") {
  const auto file = std::make_shared<const launch::SourceFile>(name, text);
  return launch::LocatedText(text, {file, 0, static_cast<std::uint32_t>(text.size())});
}

// The rendered errors of what `act` throws; "" if it throws nothing.
template <typename Act>
std::string errors_of(const Act& act) {
  try {
    act();
    return "";
  } catch (const launch::LaunchError& error) {
    return launch::render(error.diagnostics());
  }
}
