// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/reader/trace_discovery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>

#include "tracing/decode/ctf/metadata_text.hpp"
#include "tracing/decode/ctf/trace_class.hpp"
#include "tracing/decode/ctf/tsdl_cursor.hpp"
#include "tracing/decode/reader/missing_files.hpp"
#include "tracing/decode/reader/trace_read_error.hpp"

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
  if (is_trace(directory)) {
    return {directory};
  }
  for (fs::recursive_directory_iterator entry(directory), end; entry != end; ++entry) {
    if (!entry->is_directory() || !is_trace(entry->path())) {
      continue;
    }
    found.push_back(entry->path());
    entry.disable_recursion_pending();
  }
  std::sort(found.begin(), found.end());
  return found;
}

// The identity in the metadata of a directory. It is the path when the trace has no identity or can't be read; the
// reading itself then reports the error. libbabeltrace2 has a query for it, which leaves the file open in 2.0.4.
std::string identity(const fs::path& directory) {
  try {
    const std::vector<ctf::Token> tokens = ctf::tsdl_tokens(ctf::read_metadata(directory / kMetadata));
    const auto is_trace_block = [](const ctf::Token& word, const ctf::Token& next) {
      return word.is("trace") && next.is("{");
    };
    auto token = std::adjacent_find(tokens.begin(), tokens.end(), is_trace_block);
    for (; tokens.end() - token > 2 && !token->is("}"); ++token) {
      if (token[0].is("uuid") && token[1].is("=")) {
        return token[2].text;
      }
    }
  } catch (const ctf::UnsupportedTrace&) {
    // The other reader may know it.
  }
  return directory;
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
    if (const std::vector<std::string> missing = missing_metadata(directory); !missing.empty()) {
      throw TraceReadError(fmt::format("cannot read the trace '{}': {}", directory.string(), missing.front()),
                           "no other file tells what the streams hold; copy the trace again with all of its files");
    }
    throw TraceReadError(
        fmt::format("'{}' is not a trace: neither it nor a directory below it has a file '{}'", directory.string(),
                    kMetadata),
        "LTTng writes no trace when no traced process ran during the session, and none before 'snapshot record'");
  }
  return directories;
}

std::vector<TraceDirectories> group_by_identity(const std::vector<fs::path>& directories) {
  std::vector<TraceDirectories> traces;
  std::map<std::string, std::size_t> by_identity;
  for (const fs::path& path : directories) {
    const auto [known, is_new] = by_identity.try_emplace(identity(path), traces.size());
    if (is_new) {
      traces.emplace_back();
    }
    traces[known->second].push_back(path);
  }
  return traces;
}

}  // namespace tracing
