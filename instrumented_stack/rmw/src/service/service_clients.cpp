// SPDX-License-Identifier: Apache-2.0
#include "service/service_clients.hpp"

namespace rmw_fastrtps {

void ServiceClients::request_taken(const Gid& reader, const Gid& writer) {
  std::lock_guard lock(mutex_);
  writers_.insert_or_assign(reader, writer);
}

void ServiceClients::reader_matched(const Gid& reader) {
  {
    std::lock_guard lock(mutex_);
    matched_readers_.insert(reader);
  }
  changed_.notify_all();
}

void ServiceClients::reader_unmatched(const Gid& reader) {
  {
    std::lock_guard lock(mutex_);
    matched_readers_.erase(reader);
    writers_.erase(reader);
  }
  changed_.notify_all();
}

void ServiceClients::writer_unmatched(const Gid& writer) {
  {
    std::lock_guard lock(mutex_);
    std::erase_if(writers_, [&](const auto& client) { return client.second == writer; });
  }
  changed_.notify_all();
}

ServiceClients::Presence ServiceClients::wait_for_reader(const Gid& reader, std::chrono::nanoseconds patience) {
  std::unique_lock lock(mutex_);
  const auto known = [&] { return matched_readers_.contains(reader) || !writers_.contains(reader); };
  if (!changed_.wait_for(lock, patience, known)) {
    return Presence::kUnmatched;
  }
  return writers_.contains(reader) ? Presence::kMatched : Presence::kGone;
}

}  // namespace rmw_fastrtps
