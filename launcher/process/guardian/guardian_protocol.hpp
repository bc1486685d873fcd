// What the launcher tells launch-guardian: one record for each message of a sequenced-packet socket.
#pragma once

#include <sys/types.h>

#include <cstdint>

namespace launch {

struct GuardianRecord {
  enum class Kind : std::int32_t { kAttach = 1, kDetach = 2 };

  Kind kind;
  pid_t group;
};

}  // namespace launch
