// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/reader/recorded_bytes.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

namespace tracing {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr const char* kVerdict = "verdict.json";

std::map<std::string, std::uint64_t> sizes_in(const json& verdict) {
  const json damage = verdict.value("damage", json(std::string()));
  if (!damage.is_string() || !damage.get_ref<const std::string&>().empty()) {
    return {};
  }
  std::map<std::string, std::uint64_t> bytes;
  if (verdict.contains("reasons")) {  // of a snapshot
    const json domains = verdict.value("bytes", json::object());
    for (const auto& [domain, size] : domains.items()) {
      if (size.is_number_unsigned()) {
        bytes[domain] = size.get<std::uint64_t>();
      }
    }
    return bytes;
  }
  const json channels = verdict.value("channels", json());
  if (!channels.is_array()) {
    return {};
  }
  for (const json& channel : channels) {
    if (!channel.is_object() || channel.value("counted_by", json("daemon")) == "daemon") {
      continue;
    }
    const json domain = channel.value("domain", json());
    const json size = channel.value("bytes", json());
    if (domain.is_string() && size.is_number_unsigned()) {
      bytes[domain.get<std::string>()] += size.get<std::uint64_t>();
    }
  }
  return bytes;
}

}  // namespace

std::set<fs::path> verdict_files(const std::vector<fs::path>& directories) {
  std::set<fs::path> files;
  for (const fs::path& directory : directories) {
    std::error_code error;
    fs::recursive_directory_iterator entry(directory, fs::directory_options::skip_permission_denied, error);
    for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
      if (entry->path().filename() == kVerdict) {
        files.insert(entry->path());
      }
    }
  }
  return files;
}

std::vector<std::string> recorded_damage(const std::vector<fs::path>& directories) {
  std::vector<std::string> lines;
  for (const fs::path& file : verdict_files(directories)) {
    std::ifstream stream(file);
    const json verdict = json::parse(stream, nullptr, false);
    const json damage = verdict.is_object() ? verdict.value("damage", json()) : json();
    if (damage.is_string() && !damage.get_ref<const std::string&>().empty()) {
      lines.push_back(damage.get<std::string>());
    }
  }
  return lines;
}

RecordedBytes::RecordedBytes(const std::vector<fs::path>& directories) {
  for (const fs::path& file : verdict_files(directories)) {
    std::ifstream stream(file);
    const json verdict = json::parse(stream, nullptr, false);
    if (!verdict.is_object()) {
      broken_.push_back(fmt::format("'{}' is broken, so nothing tells what else is missing", file.string()));
      continue;
    }
    const fs::path directory = file.parent_path();
    recordings_[fs::weakly_canonical(directory)] = {directory, sizes_in(verdict), {}};
  }
}

void RecordedBytes::add(const fs::path& trace, const std::string& domain, std::uint64_t bytes) {
  if (recordings_.empty()) {
    return;
  }
  for (fs::path directory = fs::weakly_canonical(trace);; directory = directory.parent_path()) {
    if (const auto found = recordings_.find(directory); found != recordings_.end()) {
      found->second.there[domain] += bytes;
      return;
    }
    if (directory == directory.parent_path()) {
      return;
    }
  }
}

std::vector<std::string> RecordedBytes::missing() const {
  std::vector<std::string> lines;
  for (const auto& [path, sizes] : recordings_) {
    for (const auto& [domain, expected] : sizes.expected) {
      const auto found = sizes.there.find(domain);
      const std::uint64_t there = found == sizes.there.end() ? 0 : found->second;
      if (there < expected) {
        lines.push_back(fmt::format("'{}' lacks {} of the {} bytes that the session recorded{}",
                                    sizes.directory.string(), expected - there, expected,
                                    sizes.expected.size() == 1 ? "" : fmt::format(" in domain {}", domain)));
      }
    }
  }
  return lines;
}

}  // namespace tracing
