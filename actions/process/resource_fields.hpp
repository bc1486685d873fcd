// SPDX-License-Identifier: Apache-2.0
// The attributes of <executable> and <node> for the scheduling and limits of a process.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "launcher/language/fields.hpp"
#include "launcher/process/resource_limits.hpp"

namespace launch {

// An amount of memory: "1500000", "64K", "512M", "2G". Throws LaunchError at `where`.
std::uint64_t parse_bytes(const std::string& text, const SourceRange& where);

class ResourceFields {
 public:
  // Declarations for an ActionType.
  static std::vector<AttributeSpec> attributes();

  // Throws LaunchError for literal values that are wrong.
  explicit ResourceFields(const Fields& fields);

  // Throws LaunchError at the attribute that is wrong.
  ResourceLimits perform(Scope& scope) const;

  SourceRange where_of_cpus() const { return cpus_ ? cpus_->where() : SourceRange(); }

 private:
  // A number within bounds.
  struct Bounded {
    std::optional<NumberField> number;
    SourceRange where;
  };

  void set_policy(Scope& scope, ResourceLimits& limits) const;

  Bounded nice_;
  std::optional<Template> policy_;
  Bounded priority_;
  std::optional<Template> cpus_;
  std::optional<Template> memory_;
  Bounded open_files_;
};

}  // namespace launch
