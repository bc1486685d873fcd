// SPDX-License-Identifier: Apache-2.0
// <chain> in <trace>: a chain of callbacks with a name and a budget, for the report.
#pragma once

#include <optional>
#include <vector>

#include "actions/trace/trace_channel.hpp"
#include "launcher/language/fields.hpp"
#include "tracing/model/chains/chain_definition.hpp"

namespace launch {

class ChainFields {
 public:
  static ItemSpec item();

  explicit ChainFields(const Fields& fields);
  const SourceRange& where() const { return where_; }
  const SourceRange& nodes_where() const { return nodes_.where(); }
  // Throws LaunchError.
  tracing::ChainDefinition perform(Scope& scope) const;

 private:
  SourceRange where_;
  SourceRange name_where_;
  Template name_;
  WordsField nodes_;
  std::optional<NumberField> budget_;  // ms
  SourceRange budget_where_;
};

// Throws LaunchError when two chains have one name.
std::vector<tracing::ChainDefinition> perform_chains(const std::vector<ChainFields>& fields, Scope& scope);

}  // namespace launch
