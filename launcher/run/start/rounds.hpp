// SPDX-License-Identifier: Apache-2.0
// The requests of traversals that have not started yet, in the order of the traversals. First all scopes of a round
// begin, one after the other, then the round starts.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/run/scopes/active_scopes.hpp"
#include "launcher/visit/process_table.hpp"
#include "launcher/visit/requests.hpp"

namespace launch {

// The requests of one traversal, and its processes.
struct Round {
  Requests requests;
  std::vector<TrackedProcess*> processes;  // of requests.processes; null: it waits, and its spec was taken
};

class Rounds {
 public:
  struct Callbacks {
    // All scopes of the round have begun. The next round waits until started() is called, now or later.
    std::function<void(Round round)> start;
    // A scope can't begin: its round and the rounds behind it are dropped.
    std::function<void(const LaunchError&)> fail;
    // No round is left.
    std::function<void()> empty;
  };

  // The scopes must outlive this object.
  Rounds(ActiveScopes& scopes, Callbacks callbacks) : scopes_(scopes), callbacks_(std::move(callbacks)) {}

  void add(Round round);
  // The round that was given to `start` last has started.
  void started();
  // No round starts any more. A scope that is beginning still begins, and a round that starts has to be started(); only
  // then is this object empty.
  void close();
  bool empty() const { return rounds_.empty(); }

 private:
  void next();
  void on_begun(const std::optional<LaunchError>& error);

  ActiveScopes& scopes_;
  Callbacks callbacks_;
  std::deque<Round> rounds_;    // a scope of the first round may be beginning, or the first round starts
  std::size_t next_scope_ = 0;  // of the first round
  bool beginning_ = false;
  bool starting_ = false;  // the first round was given away
  bool giving_ = false;    // this happens now
  bool closed_ = false;
};

}  // namespace launch
