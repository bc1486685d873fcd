// SPDX-License-Identifier: Apache-2.0
// The launcher reads the files of tests/golden/interfaces as their `.expected` say. interface_files_test.py expects the
// same of the generator, and tells how these texts are made.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "base/overloaded.hpp"
#include "launcher/message_types/interface_file.hpp"
#include "test_library.hpp"

namespace {

using launch::MessageType;
using launch::MessageValue;

std::string value_text(const MessageValue& value) {
  return std::visit(launch::Overloaded{[](const std::string& text) {
                                         std::string quoted = "\"";
                                         for (const char c : text) {
                                           quoted += c == '"' || c == '\\' ? std::string("\\") + c
                                                     : c == '\n'           ? "\\n"
                                                                           : std::string(1, c);
                                         }
                                         return quoted + '"';
                                       },
                                       [](const MessageValue::List& list) {
                                         std::string text;
                                         for (const MessageValue& item : list) {
                                           text += (text.empty() ? "" : ", ") + value_text(item);
                                         }
                                         return "[" + text + "]";
                                       },
                                       [](auto number) { return fmt::format("{}", number); }},
                    value.data);
}

std::string content(const std::string& name, const MessageType& message) {
  std::string text = name + "\n";
  for (const launch::MessageConstant& constant : message.constants) {
    text += fmt::format("  constant {} {} = {}\n", to_string(constant.type), constant.name, value_text(constant.value));
  }
  for (const launch::MessageField& field : message.fields) {
    text += fmt::format("  field {} {}", to_string(field.type), field.name);
    text += field.default_value == default_value(field.type) ? "\n" : " = " + value_text(field.default_value) + "\n";
  }
  return text;
}

std::string content(const std::filesystem::path& path) {
  const auto find_message = [](const std::string& name) {
    if (name != "std_msgs/msg/Header" && name != "test/msg/Point") {
      throw launch::LaunchError("unknown type '" + name + "'", {});
    }
    MessageType message;
    message.name = name;
    return std::make_shared<const MessageType>(message);
  };
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  const auto file = std::make_shared<const launch::SourceFile>(path.filename().string(), text.str());
  const std::string name = path.stem();
  std::vector<std::string> names = {name};
  if (path.extension() == ".srv" || name == "IdlAdd") {
    names = {name + "_Request", name + "_Response"};
  } else if (path.extension() == ".action") {
    names = {name + "_Goal", name + "_Result", name + "_Feedback"};
  }
  try {
    const std::vector<MessageType> parts = path.extension() == ".idl"
                                               ? parse_idl_file(file, "test", names, find_message)
                                               : parse_interface_file(file, "test", find_message);
    EXPECT_EQ(parts.size(), names.size());
    std::string result;
    for (std::size_t i = 0; i < std::min(parts.size(), names.size()); ++i) {
      result += content(names[i], parts[i]);
    }
    return result;
  } catch (const launch::LaunchError& error) {
    const std::string rendered = launch::render(error.diagnostics());
    return rendered.substr(0, rendered.find('\n') + 1);
  }
}

// Without what only the generator says.
std::string expected_of(const std::filesystem::path& path) {
  std::ifstream file(path.string() + ".expected");
  std::string common;
  std::string own;
  for (std::string line; std::getline(file, line);) {
    constexpr std::string_view kOwn = "launcher: ";
    if (line.starts_with(kOwn)) {
      own += line.substr(kOwn.size()) + "\n";
    } else if (!line.starts_with("generator: ")) {
      common += line + "\n";
    }
  }
  return own.empty() ? common : own;
}

TEST(InterfaceFiles, LauncherReadsWhatIsExpected) {
  std::set<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(GOLDEN_INTERFACES)) {
    if (entry.is_regular_file() && entry.path().extension() != ".expected") {
      paths.insert(entry.path());
    }
  }
  EXPECT_GT(paths.size(), 30U);
  for (const std::filesystem::path& path : paths) {
    EXPECT_EQ(content(path), expected_of(path)) << path.filename();
  }
}

}  // namespace
