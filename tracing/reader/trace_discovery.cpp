// SPDX-License-Identifier: Apache-2.0
#include "tracing/reader/trace_discovery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "tracing/reader/trace_read_error.hpp"

namespace tracing {

namespace fs = std::filesystem;

namespace {

// A directory is a CTF trace when it holds a file of this name.
constexpr const char* kMetadata = "metadata";

bool is_trace(const fs::path& directory) {
  return fs::is_regular_file(directory / kMetadata);
}

std::vector<fs::path> trace_directories(const fs::path& directory) {
  std::vector<fs::path> found;
  if (is_trace(directory)) return {directory};
  for (fs::recursive_directory_iterator entry(directory), end; entry != end; ++entry) {
    if (!entry->is_directory() || !is_trace(entry->path())) continue;
    found.push_back(entry->path());
    entry.disable_recursion_pending();
  }
  std::sort(found.begin(), found.end());
  return found;
}

// The identity of the trace in a directory, as the plugin reads it from the metadata. It is the path when the trace has
// no identity or can't be read; the reading itself then reports the error.
std::string identity(const bt_component_class_source* ctf_fs, const fs::path& directory) {
  babeltrace::Value parameters(bt_value_map_create());
  babeltrace::check(bt_value_map_insert_string_entry(parameters.get(), "type", "directory"), "bt_value_map_insert");
  babeltrace::check(bt_value_map_insert_string_entry(parameters.get(), "input", directory.c_str()),
                    "bt_value_map_insert");
  const babeltrace::QueryExecutor query(bt_query_executor_create(
      bt_component_class_source_as_component_class_const(ctf_fs), "babeltrace.support-info", parameters.get()));
  const bt_value* answer = nullptr;
  if (bt_query_executor_query(query.get(), &answer) != BT_QUERY_EXECUTOR_QUERY_STATUS_OK) {
    bt_current_thread_clear_error();
    return directory;
  }
  const babeltrace::ConstValue owned(answer);
  if (!bt_value_is_map(answer)) return directory;
  const bt_value* group = bt_value_map_borrow_entry_value_const(answer, "group");
  if (group == nullptr || !bt_value_is_string(group)) return directory;
  return bt_value_string_get(group);
}

}  // namespace

std::vector<fs::path> find_traces(const fs::path& directory) {
  std::error_code error;
  if (!fs::exists(directory, error)) {
    throw TraceReadError(fmt::format("cannot read the trace '{}': no such directory", directory.string()),
                         "give the directory that the launcher printed when it ended the session");
  }
  if (!fs::is_directory(directory, error)) {
    throw TraceReadError(fmt::format("cannot read the trace '{}': not a directory", directory.string()),
                         "a trace is a directory; give the one that holds this file");
  }
  std::vector<fs::path> directories;
  try {
    directories = trace_directories(directory);
  } catch (const fs::filesystem_error& failure) {
    throw TraceReadError(fmt::format("cannot read the trace '{}': {}: {}", directory.string(), failure.path1().string(),
                                     failure.code().message()),
                         "check the permissions of the directories below it");
  }
  if (directories.empty()) {
    throw TraceReadError(
        fmt::format("'{}' is not a trace: neither it nor a directory below it has a file '{}'", directory.string(),
                    kMetadata),
        "LTTng writes no trace when no traced process ran during the session, and none before 'snapshot record'");
  }
  return directories;
}

std::vector<TraceDirectories> group_by_identity(const bt_component_class_source* ctf_fs,
                                                const std::vector<fs::path>& directories) {
  std::vector<TraceDirectories> traces;
  std::map<std::string, std::size_t> by_identity;
  for (const fs::path& path : directories) {
    const auto [known, is_new] = by_identity.try_emplace(identity(ctf_fs, path), traces.size());
    if (is_new) traces.emplace_back();
    traces[known->second].push_back(path);
  }
  return traces;
}

}  // namespace tracing
