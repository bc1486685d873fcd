// SPDX-License-Identifier: Apache-2.0
// Whether a reader can open what has been recorded. A recording consists of several traces where each process has
// buffers of its own. A reader such as babeltrace2 gives up all of them when it cannot open one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tracing/record/account/absence.hpp"

namespace tracing {

// A trace that cannot be opened.
struct UnreadableTrace {
  std::filesystem::path directory;  // of its metadata and streams
  std::string why;                  // "it has no description of its streams"
  bool is_empty = false;            // no event is in it
};

// Opens each trace in `folder` and below as a reader does.
std::vector<UnreadableTrace> find_unreadable(const std::filesystem::path& folder);

// Puts the unreadable traces of processes aside: moves them to `unreadable` in the recording's directory, where readers
// find no metadata of them. LTTng leaves such a trace when a process ends before it is registered. A trace with events
// is a loss, one without is nothing to tell.
std::vector<Absence> put_unreadable_aside(const std::filesystem::path& directory);

// A sentence on the traces that all processes of a user share and that cannot be opened. "" if there are none.
std::string describe_unreadable(const std::filesystem::path& directory);

}  // namespace tracing
