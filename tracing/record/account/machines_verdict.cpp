// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/account/machines_verdict.hpp"

#include <fmt/core.h>

#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "base/files/replace_file.hpp"
#include "tracing/record/account/verdict.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace tracing {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestVerdict = std::uintmax_t{64} << 20;

// Null if there is none. It may come from another machine: any of its fields may be anything.
Json verdict_in(const fs::path& directory) {
  const fs::path path = directory / kVerdictFile;
  std::error_code failed;
  if (!fs::is_regular_file(fs::symlink_status(path, failed)) || fs::file_size(path, failed) > kLargestVerdict) {
    return nullptr;
  }
  std::ifstream file(path);
  Json verdict = Json::parse(file, nullptr, false);
  return verdict.is_object() ? verdict : Json(nullptr);
}

void write(const fs::path& directory, const Json& verdict) {
  try {
    launch::replace_file(directory / kVerdictFile, verdict.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  } catch (const std::system_error& error) {
    throw TraceError(fmt::format("cannot write {}: {}", (directory / kVerdictFile).string(), error.code().message()));
  }
}

bool says_true(const Json& verdict, const char* field) {
  return verdict.contains(field) && verdict[field].is_boolean() && verdict[field].get<bool>();
}

}  // namespace

bool write_machines_verdict(const fs::path& directory, const std::string& session_name,
                            const std::vector<MachinePart>& parts, const SnapshotReasons* snapshot) {
  bool all_complete = true;
  Json machines = Json::array();
  Json absent = Json::array();
  for (const MachinePart& part : parts) {
    Json entry{{"machine", part.machine}};
    bool complete = part.nothing;
    std::string problem = part.problem;
    if (!part.folder.empty()) {
      entry["folder"] = part.folder;
      const Json verdict = verdict_in(directory / part.folder);
      complete = says_true(verdict, "complete") && !says_true(verdict, "cut_short");
      if (verdict.is_null() && problem.empty()) {
        problem = fmt::format("the recording of machine '{}' has no verdict", part.machine);
      }
      for (const char* const count : {"discarded_events", "lost_packets"}) {
        if (verdict.contains(count) && verdict[count].is_number_unsigned()) {
          entry[count] = verdict[count];
        }
      }
    }
    if (!part.left_there.empty()) {
      entry["left_there"] = part.left_there;
    }
    if (!problem.empty()) {
      complete = false;
      entry["problem"] = problem;
      absent.push_back(problem);
    }
    entry["complete"] = complete;
    all_complete = all_complete && complete;
    machines.push_back(std::move(entry));
  }
  Json json = {{"session", session_name}};
  if (snapshot != nullptr) {
    json["reasons"] = snapshot->reasons;
    json["time_ns"] = snapshot->time_ns;
  }
  json.update({{"complete", all_complete}, {"damage", ""}, {"absent", absent}, {"machines", machines}});
  std::error_code failed;
  fs::create_directories(directory, failed);
  write(directory, json);
  return all_complete;
}

void note_problems(const fs::path& directory, const std::vector<std::string>& problems) {
  Json verdict = verdict_in(directory);
  if (verdict.is_null()) {
    throw TraceError(fmt::format("cannot read {}", (directory / kVerdictFile).string()));
  }
  verdict["complete"] = false;
  if (!verdict.contains("absent") || !verdict["absent"].is_array()) {
    verdict["absent"] = Json::array();
  }
  for (const std::string& problem : problems) {
    verdict["absent"].push_back(problem);
  }
  write(directory, verdict);
}

}  // namespace tracing
