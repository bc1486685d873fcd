// SPDX-License-Identifier: Apache-2.0
// What liblttng-ctl lists: an array that it allocates and the caller frees.
//
//   const LttngList<lttng_session> sessions("list the trace sessions", lttng_list_sessions);
//   for (const lttng_session& session : sessions) …
#pragma once

#include <cstdlib>
#include <memory>
#include <string>

#include "tracing/record/lttng/lttng_error.hpp"

namespace tracing {

template <typename Item>
class LttngList {
 public:
  // Calls list(arguments..., Item**), which returns a number of items or an error. Throws TraceError, for which `doing`
  // names what was tried (lttng_error.hpp).
  template <typename List, typename... Arguments>
  LttngList(const std::string& doing, List list, Arguments... arguments) {
    Item* items = nullptr;
    const int count = list(arguments..., &items);
    items_.reset(items);
    count_ = check_lttng(count, doing);
  }

  // Not const: LTTng's functions that read an item want it so.
  Item* begin() const { return items_.get(); }
  Item* end() const { return items_.get() + count_; }

 private:
  struct Free {
    void operator()(Item* items) const { std::free(items); }
  };

  std::unique_ptr<Item, Free> items_;
  int count_ = 0;
};

}  // namespace tracing
