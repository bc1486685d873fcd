// SPDX-License-Identifier: Apache-2.0
// How `launch trace record_snapshot` asks a launch for a snapshot of all its machines: by a socket whose name tells
// user and session, which is no file and goes with the launch. A launch with a network of its own is not reached.
#pragma once

#include <optional>
#include <string>

#include "base/files/unique_fd.hpp"

namespace launch {

struct SnapshotAnswer {
  std::string directory = {};
  bool complete = false;
  std::string error = {};  // a sentence: there is none
};

// For the launch. Readable when somebody asks. Empty when another launch has a session of this name.
UniqueFd listen_for_snapshots(const std::string& session);
// Takes who asks; empty if nobody does, or another user. The answer is sent once, without waiting.
UniqueFd take_snapshot_request(const UniqueFd& listener);
void send_snapshot_answer(const UniqueFd& asker, const SnapshotAnswer& answer);

// For the command. Waits until all of the snapshot is there. Nothing if no launch of this user has the session.
std::optional<SnapshotAnswer> ask_for_snapshot(const std::string& session);

}  // namespace launch
