// SPDX-License-Identifier: Apache-2.0
// The chains that a user has named, as the launcher writes them beside a trace and the report reads them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tracing {

// A chain of callbacks that cause one another. It begins with a callback of the first node and ends with a callback of
// the last one; it passes the nodes between in this order, and maybe others.
struct ChainDefinition {
  std::string name;
  std::vector<std::string> nodes;         // patterns of the shell for fully qualified names; two at least
  std::optional<std::int64_t> budget_ns;  // so long the first output that an input causes may take

  bool operator==(const ChainDefinition&) const = default;
};

// The file beside a trace.
inline constexpr const char* kChainsFile = "chains.json";

// Writes the file; makes the directory if it does not exist. Throws std::system_error.
void write_chains(const std::vector<ChainDefinition>& chains, const std::filesystem::path& directory);

// The chains of all files in the directory and below it, each once. A part of a trace, such as one snapshot, has those
// of a directory above, at most two levels. Throws std::runtime_error for a file that does not hold chains.
std::vector<ChainDefinition> read_chains(const std::filesystem::path& directory);

}  // namespace tracing
