// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/account/ended_processes.hpp"

#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "base/files/replace_file.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFile = "ended.json";

}  // namespace

std::map<std::string, EventCounts> read_ended_processes(const fs::path& directory) {
  std::map<std::string, EventCounts> ended;
  std::ifstream file(directory / kFile);
  const nlohmann::json json = nlohmann::json::parse(file, nullptr, false);
  if (!json.is_object()) {
    return ended;
  }
  for (const auto& [name, process] : json.items()) {
    ended.emplace(name, EventCounts{.pid = process.value("pid", std::int64_t{0}),
                                    .process = process.value("process", ""),
                                    .begin = process.value("begin", std::uint64_t{0}),
                                    .end = process.value("end", std::uint64_t{0}),
                                    .cpu = process.value("cpu", std::uint64_t{0}),
                                    .reached = process.value("reached", std::uint64_t{0}),
                                    .missed = process.value("missed", std::uint64_t{0}),
                                    .events = process.value("events", std::map<std::string, std::uint64_t>())});
  }
  return ended;
}

bool write_ended_processes(const fs::path& directory, const std::map<std::string, EventCounts>& ended) {
  nlohmann::json json = nlohmann::json::object();
  for (const auto& [name, process] : ended) {
    json[name] = {{"pid", process.pid},       {"process", process.process}, {"begin", process.begin},
                  {"end", process.end},       {"cpu", process.cpu},         {"reached", process.reached},
                  {"missed", process.missed}, {"events", process.events}};
  }
  try {
    launch::replace_file((directory / kFile).string(),
                         json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  } catch (const std::system_error&) {
    return false;
  }
  return true;
}

}  // namespace tracing
