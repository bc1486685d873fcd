// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/check/finding_baseline.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "programs/launch/check/finding_table.hpp"

namespace launch {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Key = std::tuple<std::string, std::string, std::string>;  // file, id, message

constexpr int kVersion = 1;

Key key_of(const Diagnostic& diagnostic, const std::string& baseline) {
  std::error_code ignored;
  const fs::path folder = fs::weakly_canonical(fs::absolute(baseline, ignored), ignored).parent_path();
  std::string file;
  if (diagnostic.where) {
    const fs::path path = fs::weakly_canonical(fs::absolute(diagnostic.where.file->path(), ignored), ignored);
    file = path.lexically_relative(folder).string();
  }
  return {file, finding_id(diagnostic.finding), diagnostic.message};
}

[[noreturn]] void fail(const std::string& path, const std::string& why) {
  throw LaunchError(fmt::format("'{}' is no baseline: {}", path, why), {}, "--write-baseline FILE makes one");
}

}  // namespace

void write_baseline(const std::string& path, const std::vector<Diagnostic>& found) {
  std::map<Key, std::size_t> counts;
  for (const Diagnostic& diagnostic : found) {
    ++counts[key_of(diagnostic, path)];
  }
  Json root = {{"version", kVersion}, {"findings", Json::array()}};
  for (const auto& [key, count] : counts) {
    const auto& [file, id, message] = key;
    root["findings"].push_back({{"file", file}, {"id", id}, {"message", message}, {"count", count}});
  }
  std::ofstream file(path);
  if (!(file << root.dump(2, ' ', false, Json::error_handler_t::replace) << "\n") || !file.flush()) {
    throw LaunchError(fmt::format("'{}' can't be written", path), {});
  }
}

ComparedWithBaseline leave_out_known(const std::string& path, std::vector<Diagnostic>& found) {
  std::ifstream file(path);
  if (!file) {
    throw LaunchError(fmt::format("the baseline '{}' can't be read", path), {}, "--write-baseline FILE makes one");
  }
  std::map<Key, std::size_t> left;
  ComparedWithBaseline compared;
  try {
    const Json root = Json::parse(std::string(std::istreambuf_iterator<char>(file), {}));
    if (root.at("version") != kVersion) {
      fail(path, fmt::format("its version is {}, not {}", root.at("version").dump(), kVersion));
    }
    for (const Json& one : root.at("findings")) {
      const auto count = one.at("count").get<std::size_t>();
      left[{one.at("file").get<std::string>(), one.at("id").get<std::string>(),
            one.at("message").get<std::string>()}] += count;
      compared.gone += count;
    }
  } catch (const Json::exception&) {
    fail(path, "launch check has not written what it holds");
  }
  std::erase_if(found, [&](const Diagnostic& diagnostic) {
    const auto known = left.find(key_of(diagnostic, path));
    if (known == left.end() || known->second == 0) {
      return false;
    }
    --known->second;
    ++compared.known;
    --compared.gone;
    return true;
  });
  return compared;
}

}  // namespace launch
