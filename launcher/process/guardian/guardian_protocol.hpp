// SPDX-License-Identifier: Apache-2.0
// The messages of the launcher to launch-guardian: one record for each message of a sequenced-packet socket.
#pragma once

#include <cstddef>
#include <cstdint>

namespace launch {

struct GuardianRecord {
  enum class Kind : std::int32_t { kAttach = 1, kDetach = 2, kAddCleanUp = 3, kRemoveCleanUp = 4 };

  Kind kind;
  std::int32_t id;  // the process group, or the number of a clean-up command
};

// After the record of kAddCleanUp the words of the command follow, each with a zero byte at its end.
constexpr std::size_t kLongestCleanUp = 8192;  // bytes of all words

}  // namespace launch
