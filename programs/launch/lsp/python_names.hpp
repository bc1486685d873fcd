// SPDX-License-Identifier: Apache-2.0
// The names that Python launch files import: modules, classes, functions and their arguments. The build writes the
// table from the packages themselves (write_python_names.py).
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace launch::lsp {

struct PythonNameArgument {
  std::string name;
  bool required = false;
  bool positional = false;
};

struct PythonName {
  std::string kind;  // "class", "function", "value"
  std::string help;
  std::string tag;  // of XML that means the same; "" if there is none
  std::vector<PythonNameArgument> arguments;
  bool complete = false;  // it takes no others
};

class PythonNames {
 public:
  using Module = std::map<std::string, PythonName>;

  // The table of this installation, empty if it has none. Read when it is needed first.
  static const PythonNames& of_installation();

  const std::map<std::string, Module>& modules() const { return modules_; }
  const Module* module(std::string_view name) const;
  // By "launch_ros.actions.Node"; nullptr for a name that the table does not have.
  const PythonName* find(std::string_view full_name) const;
  // The modules from which this name is imported, the usual one first.
  std::vector<std::string> homes_of(std::string_view name) const;

 private:
  std::map<std::string, Module> modules_;
};

}  // namespace launch::lsp
