// SPDX-License-Identifier: Apache-2.0
#include "actions/trace/trace_chain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "launcher/language/setting.hpp"

namespace launch {

ItemSpec ChainFields::item() {
  return {.tag = "chain",
          .help = "a chain of callbacks that cause one another, which launch report shows by this name",
          .attributes = {{"name", AttributeType::kText, true, "", "its name"},
                         {"nodes", AttributeType::kWords, true, "",
                          "the nodes that it passes, from the first to the last; * matches any text, and other nodes "
                          "may lie between"},
                         {"budget", AttributeType::kFloat, false, "none",
                          "milliseconds that it may take from an input to the first output that it causes"}},
          .items = {},
          .extension = true};
}

tracing::ChainDefinition ChainFields::perform(Scope& scope) const {
  tracing::ChainDefinition chain;
  chain.name = fields_.text("name").perform(scope);
  if (chain.name.empty()) {
    throw LaunchError("the name of the chain is empty", fields_.where("name"),
                      "launch report shows the chain by its name");
  }
  chain.nodes = perform_names(fields_, "nodes", scope);
  if (chain.nodes.size() < 2) {
    throw LaunchError(fmt::format("chain '{}' needs two nodes at least", chain.name), nodes_where(),
                      "name the node where it begins, and the node where it ends");
  }
  for (std::string& node : chain.nodes) {
    if (node.front() != '/' && node.front() != '*') {
      node.insert(node.begin(), '/');
    }
  }
  if (const std::optional<NumberField> budget = fields_.number("budget")) {
    const double milliseconds = budget->perform(scope);
    if (!(milliseconds > 0)) {
      throw LaunchError(fmt::format("the budget of chain '{}' is not above 0", chain.name), fields_.where("budget"),
                        "write milliseconds, such as 50, or leave out the budget");
    }
    chain.budget_ns = std::llround(milliseconds * 1e6);
  }
  return chain;
}

std::vector<tracing::ChainDefinition> perform_chains(const std::vector<ChainFields>& fields, Scope& scope) {
  std::vector<tracing::ChainDefinition> chains;
  for (const ChainFields& field : fields) {
    tracing::ChainDefinition chain = field.perform(scope);
    const bool is_twice =
        std::any_of(chains.begin(), chains.end(), [&chain](const auto& other) { return other.name == chain.name; });
    if (is_twice) {
      throw LaunchError(fmt::format("there are two chains '{}'", chain.name), field.where(),
                        "give each chain a name of its own");
    }
    chains.push_back(std::move(chain));
  }
  return chains;
}

}  // namespace launch
