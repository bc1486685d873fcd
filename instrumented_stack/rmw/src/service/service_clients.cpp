// SPDX-License-Identifier: Apache-2.0
#include "service/service_clients.hpp"

#include <utility>

namespace rmw_fastrtps {

void ServiceClients::request_taken(const Gid& reader, const Gid& writer) {
  const std::lock_guard lock(mutex_);
  clients_[reader].writer = writer;
}

void ServiceClients::reader_matched(const Gid& reader) {
  std::vector<Send> due;
  {
    const std::lock_guard lock(mutex_);
    matched_readers_.insert(reader);
    if (const auto client = clients_.find(reader); client != clients_.end()) {
      due.swap(client->second.waiting);
    }
  }
  for (const Send& send : due) {
    send();
  }
  const std::lock_guard lock(mutex_);
  forget(due.size());
}

void ServiceClients::reader_unmatched(const Gid& reader) {
  const std::lock_guard lock(mutex_);
  matched_readers_.erase(reader);
  if (const auto client = clients_.find(reader); client != clients_.end()) {
    forget(client->second.waiting.size());
    clients_.erase(client);
  }
}

void ServiceClients::writer_unmatched(const Gid& writer) {
  const std::lock_guard lock(mutex_);
  std::erase_if(clients_, [&](const auto& client) {
    const bool is_gone = client.second.writer == writer;
    forget(is_gone ? client.second.waiting.size() : 0);
    return is_gone;
  });
}

ServiceClients::Presence ServiceClients::presence_of(const Gid& reader) const {
  const std::lock_guard lock(mutex_);
  if (!clients_.contains(reader)) {
    return Presence::kGone;
  }
  return matched_readers_.contains(reader) ? Presence::kMatched : Presence::kUnmatched;
}

bool ServiceClients::send_when_matched(const Gid& reader, Send send) {
  {
    const std::lock_guard lock(mutex_);
    const auto client = clients_.find(reader);
    if (client == clients_.end()) {
      return true;
    }
    if (!matched_readers_.contains(reader)) {
      std::vector<Send>& waiting = client->second.waiting;
      if (waiting.size() == kMostWaiting) {
        return false;
      }
      waiting.push_back(std::move(send));
      ++waiting_;
      return true;
    }
  }
  send();
  return true;
}

void ServiceClients::wait_until_sent(std::chrono::nanoseconds patience) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, patience, [this] { return waiting_ == 0; });
}

void ServiceClients::forget(std::size_t responses) {
  waiting_ -= responses;
  changed_.notify_all();
}

}  // namespace rmw_fastrtps
