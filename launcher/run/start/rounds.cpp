// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/start/rounds.hpp"

#include <utility>

namespace launch {

void Rounds::add(Round round) {
  rounds_.push_back(std::move(round));
  if (rounds_.size() == 1) {
    next();
  }
}

void Rounds::next() {
  while (!rounds_.empty()) {
    Requests& requests = rounds_.front().requests;
    if (next_scope_ < requests.scopes.size()) {
      beginning_ = true;
      scopes_.begin(std::move(requests.scopes[next_scope_++]), requests.processes,
                    [this](const std::optional<LaunchError>& error) { on_begun(error); });
      return;
    }
    next_scope_ = 0;
    starting_ = giving_ = true;
    callbacks_.start(std::move(rounds_.front()));
    giving_ = false;
    if (starting_) {
      return;
    }
  }
  callbacks_.empty();
}

void Rounds::started() {
  starting_ = false;
  rounds_.pop_front();
  if (closed_) {
    rounds_.clear();
  }
  if (!giving_) {
    next();
  }
}

void Rounds::on_begun(const std::optional<LaunchError>& error) {
  beginning_ = false;
  if (error || closed_) {
    close();
  }
  if (error) {
    callbacks_.fail(*error);
  } else {
    next();
  }
}

void Rounds::close() {
  closed_ = true;
  if (!beginning_ && !starting_) {
    rounds_.clear();
  }
}

}  // namespace launch
