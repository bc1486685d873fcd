// SPDX-License-Identifier: Apache-2.0
// Which launch arguments the text of a file reads.
#pragma once

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics/source.hpp"

namespace launch {

// The arguments that a file may read: it has $(var NAME), or reads a name that is computed, or it is a Python launch
// file that has the name as a text. The text is searched once for all names, but for that of Python.
class ArgumentUse {
 public:
  explicit ArgumentUse(std::shared_ptr<const SourceFile> file);

  bool may_read(std::string_view name) const;

 private:
  std::shared_ptr<const SourceFile> python_;  // null for other files
  std::set<std::string, std::less<>> names_;
  bool computes_names_ = false;
};

// The same of one name.
bool may_read(const SourceFile& file, std::string_view name);

// Whether the launcher itself reads the configuration.
bool is_own_configuration(std::string_view name);
// Those configurations.
std::vector<std::string> own_configurations();

}  // namespace launch
