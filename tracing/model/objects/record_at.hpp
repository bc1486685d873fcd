// SPDX-License-Identifier: Apache-2.0
// Lists of records by the id of an object, a process or a path, which grow when an id is asked for. Nearly each event
// asks for some, and hardly any of them is new.
#pragma once

#include <cstddef>
#include <vector>

namespace tracing {

template <class Record>
[[gnu::noinline, gnu::cold]] void make_records(std::vector<Record>& records, std::size_t id) {
  records.resize(id + 1);
}

// The record with this id. What was got before is no longer valid if it is a new one.
template <class Record>
[[gnu::always_inline]] inline Record& record_at(std::vector<Record>& records, std::size_t id) {
  if (id >= records.size()) [[unlikely]] {
    make_records(records, id);
  }
  return records[id];
}

}  // namespace tracing
