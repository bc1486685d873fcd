// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/chains/chain_definition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>

#include "base/files/replace_file.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double kNsInMs = 1e6;
constexpr int kLevelsAbove = 2;

[[noreturn]] void fail(const fs::path& file, const std::string& why) {
  throw std::runtime_error(fmt::format("the chains in '{}' cannot be read: {}", file.string(), why));
}

// A name without a slash or star in front is one below the root, as in a launch file.
std::string below_root(const std::string& node) {
  const bool is_full = !node.empty() && (node.front() == '/' || node.front() == '*');
  return is_full ? node : "/" + node;
}

ChainDefinition chain_of(const Json& json, const fs::path& file) {
  ChainDefinition chain;
  if (json.is_object() && json.contains("name") && json["name"].is_string()) {
    chain.name = json["name"].get<std::string>();
  }
  if (chain.name.empty()) {
    fail(file, "a chain has no name");
  }
  if (json.contains("nodes") && json["nodes"].is_array()) {
    for (const Json& node : json["nodes"]) {
      if (!node.is_string()) {
        fail(file, fmt::format("the nodes of chain '{}' are not all texts", chain.name));
      }
      chain.nodes.push_back(below_root(node.get<std::string>()));
    }
  }
  if (chain.nodes.size() < 2) {
    fail(file, fmt::format("chain '{}' has less than two nodes", chain.name));
  }
  if (json.contains("budget_ms") && !json["budget_ms"].is_null()) {
    const bool is_time = json["budget_ms"].is_number() && json["budget_ms"].get<double>() > 0;
    if (!is_time) {
      fail(file, fmt::format("budget_ms of chain '{}' is not a number above 0", chain.name));
    }
    chain.budget_ns = std::llround(json["budget_ms"].get<double>() * kNsInMs);
  }
  return chain;
}

void read_file(const fs::path& file, std::vector<ChainDefinition>& chains) {
  std::ifstream stream(file);
  const Json json = Json::parse(stream, nullptr, false);
  if (!json.is_object() || !json.contains("chains") || !json["chains"].is_array()) {
    fail(file, "it has no list 'chains'");
  }
  for (const Json& entry : json["chains"]) {
    ChainDefinition chain = chain_of(entry, file);
    if (std::find(chains.begin(), chains.end(), chain) == chains.end()) {
      chains.push_back(std::move(chain));
    }
  }
}

}  // namespace

void write_chains(const std::vector<ChainDefinition>& chains, const fs::path& directory) {
  Json json{{"version", 1}, {"chains", Json::array()}};
  for (const ChainDefinition& chain : chains) {
    Json entry{{"name", chain.name}, {"nodes", chain.nodes}};
    if (chain.budget_ns) {
      entry["budget_ms"] = static_cast<double>(*chain.budget_ns) / kNsInMs;
    }
    json["chains"].push_back(std::move(entry));
  }
  const launch::UniqueFd opened = launch::open_or_make_directory(directory.string());
  launch::replace_file(opened, kChainsFile, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

std::vector<ChainDefinition> read_chains(const fs::path& directory) {
  std::vector<fs::path> files;
  std::error_code error;
  fs::recursive_directory_iterator entry(directory, fs::directory_options::skip_permission_denied, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    if (entry->path().filename() == kChainsFile) {
      files.push_back(entry->path());
    }
  }
  fs::path above = directory;
  for (int level = 0; files.empty() && level < kLevelsAbove && above.has_relative_path(); ++level) {
    above = above.parent_path();
    if (fs::exists(above / kChainsFile, error)) {
      files.push_back(above / kChainsFile);
    }
  }
  std::sort(files.begin(), files.end());
  std::vector<ChainDefinition> chains;
  for (const fs::path& file : files) {
    read_file(file, chains);
  }
  return chains;
}

}  // namespace tracing
