// SPDX-License-Identifier: Apache-2.0
// What the text of a Python launch file tells of values without running it: texts, paths of packages, files, arguments.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "programs/launch/lsp/argument_places.hpp"
#include "programs/launch/lsp/declared_argument.hpp"
#include "programs/launch/lsp/python_source.hpp"

namespace launch::lsp {

// A Python launch file as the server reads it.
struct PythonFileText {
  std::function<std::string(const std::string& package)> share;  // PREFIX/share/PACKAGE; "" if there is none
  const std::string& path;
  std::string_view text;
  const PythonSource& source;

  // The text that an expression comes to: literals and what joins them, `os.path.join`, `get_package_share_directory`,
  // `FindPackageShare`, `PathJoinSubstitution`, `ThisLaunchFileDir`, variables; defaults of arguments for
  // `LaunchConfiguration`. nullopt if it is not known before a run.
  std::optional<std::string> value(std::size_t first, std::size_t last, int depth = 0) const;
  std::optional<std::string> value(const PythonArgument* argument, int depth = 0) const;
  // The content of a single literal.
  std::optional<Span> literal(const PythonArgument* argument) const;
  // The last part of the full name of a call: "Node"; "" for what is not of the table's packages.
  std::string short_name(const PythonBrackets& call) const;
  // The file that an IncludeLaunchDescription names; "" if it is not known.
  std::string included(const PythonBrackets& include) const;

 private:
  std::optional<std::string> value_of_call(const PythonBrackets& call, int depth) const;
  std::optional<std::string> joined(const PythonBrackets& brackets, std::string_view separator, int depth) const;
};

// As argument_places() of XML and YAML. `include` is the number of the brackets of an IncludeLaunchDescription.
std::vector<ArgumentPlace> python_argument_places(const PythonFileText& file);

// The arguments that the file declares.
std::vector<DeclaredArgument> python_arguments(const PythonFileText& file);

}  // namespace launch::lsp
