// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <unordered_map>

#include "probes/probes.hpp"

namespace tracetools {

// What a session has got from state dumps of this process.
struct KnownSession {
  std::uint32_t mark = 0;
  // By tracepoint: the number of the newest event that existed at the last dump. The session has all up to it.
  std::unordered_map<const Tracepoint*, std::uint64_t> dumped;
  // A tracepoint that has a ProbeMark after the session's probe. Null before the first dump, or, if the session was
  // first, before the first init event.
  const Tracepoint* reference = nullptr;
  // The session has asked for the state before it could record an init event: it was there before the process.
  bool was_first = false;
};

// The sessions that this process has seen. LTTng gives a session no number. The address alone does not identify it,
// because a later session may get the address of one that was destroyed. So each session is marked.
class SessionMemory {
 public:
  // Makes an entry if there is none. The session must not be freed meanwhile.
  KnownSession& operator[](Session* session);

 private:
  std::unordered_map<const Session*, KnownSession> known_;
  std::uint32_t last_mark_ = 0;
};

}  // namespace tracetools
