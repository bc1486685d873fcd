// SPDX-License-Identifier: Apache-2.0
// The attributes of a <fault> of a disk: do="fill_disk" path="…".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "launcher/language/fields.hpp"
#include "launcher/visit/fault_request.hpp"

namespace launch {

class DiskFaultFields {
 public:
  // The attributes of the ActionType that other faults don't have.
  static std::vector<AttributeSpec> attributes();

  // Throws LaunchError for literal values that are wrong.
  explicit DiskFaultFields(const Fields& fields);

  // As draws of the seed know it: the path as it is written, because each run has directories of its own.
  std::string identity() const;
  // Throws LaunchError.
  DiskFault perform(Scope& scope) const;

 private:
  SourceRange where_;
  std::optional<Template> path_;
  std::optional<Template> free_;
};

}  // namespace launch
