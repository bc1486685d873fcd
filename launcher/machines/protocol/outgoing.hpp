// SPDX-License-Identifier: Apache-2.0
// Bytes on their way into a connection that takes them when it can.
#pragma once

#include <cstddef>
#include <mutex>
#include <string>
#include <string_view>

#include "base/files/unique_fd.hpp"

namespace launch {

// Several threads may call its functions. SIGPIPE must be ignored.
class Outgoing {
 public:
  // Makes the descriptor non-blocking.
  explicit Outgoing(UniqueFd fd);

  // Adds bytes that belong together, and writes what the connection takes now. False when nobody reads it any more.
  bool add(std::string_view bytes);
  // Writes what the connection takes now.
  bool flush();
  // What has not been taken yet.
  std::size_t waiting() const;
  // Closes the connection. What waits is dropped.
  void close();
  // Gives the connection away.
  UniqueFd take();
  // From now on it is another connection, to which what waits for this one does not belong.
  void use(UniqueFd fd);

  // To be watched; -1 when it is closed.
  int fd() const;

 private:
  bool write_some();

  mutable std::mutex mutex_;
  UniqueFd fd_;
  std::string bytes_;
  std::size_t begin_ = 0;  // of what has not been written
  bool broken_ = false;
};

}  // namespace launch
