// SPDX-License-Identifier: Apache-2.0
// <chain> in <trace>: a chain of callbacks with a name and a budget, for the report.
#pragma once

#include <vector>

#include "launcher/language/fields.hpp"
#include "tracing/model/chains/chain_definition.hpp"

namespace launch {

class ChainFields {
 public:
  static ItemSpec item();

  explicit ChainFields(const Fields& fields) : fields_(fields) {}
  const SourceRange& where() const { return fields_.where(); }
  const SourceRange& nodes_where() const { return fields_.where("nodes"); }
  // Throws LaunchError.
  tracing::ChainDefinition perform(Scope& scope) const;

 private:
  Fields fields_;
};

// Throws LaunchError when two chains have one name.
std::vector<tracing::ChainDefinition> perform_chains(const std::vector<ChainFields>& fields, Scope& scope);

}  // namespace launch
