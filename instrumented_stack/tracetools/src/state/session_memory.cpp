// SPDX-License-Identifier: Apache-2.0
#include "state/session_memory.hpp"

#include <cstddef>
#include <cstring>

namespace tracetools {
namespace {

// The mark is in the gap between the first two fields of struct lttng_ust_session: a number of 32 bits and a pointer.
// lttng-ust allocates the struct with zeros. Its interface promises that fields are only added at the end, so nothing
// else will be in the gap.
constexpr std::size_t kMark = offsetof(Session, struct_size) + sizeof(Session::struct_size);
constexpr bool kHasGap = offsetof(Session, priv) >= kMark + sizeof(std::uint32_t);

std::uint32_t mark_of(const Session* session) {
  std::uint32_t mark = 0;
  if (kHasGap) {
    std::memcpy(&mark, reinterpret_cast<const char*>(session) + kMark, sizeof mark);
  }
  return mark;
}

void set_mark(Session* session, std::uint32_t mark) {
  if (kHasGap) {
    std::memcpy(reinterpret_cast<char*>(session) + kMark, &mark, sizeof mark);
  }
}

}  // namespace

KnownSession& SessionMemory::operator[](Session* session) {
  KnownSession& known = known_[session];
  if (known.mark == 0 || mark_of(session) != known.mark) {
    known = {.mark = ++last_mark_, .dumped = {}, .reference = nullptr, .was_first = false};
    set_mark(session, known.mark);
  }
  return known;
}

}  // namespace tracetools
