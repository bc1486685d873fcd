// SPDX-License-Identifier: Apache-2.0
// The callbacks of a trace, and which one is at an address.
//
// A callback may run before an event tells whom it belongs to, and a new one may get the address of an older one. So a
// callback gets its owner once; with another owner or another symbol it is a new callback.
#pragma once

#include <string_view>
#include <vector>

#include "tracing/model/objects/handle_index.hpp"
#include "tracing/model/objects/objects.hpp"

namespace tracing {

class CallbackTable {
 public:
  using Owner = CallbackObject::Owner;

  // `earlier` must outlive this object.
  explicit CallbackTable(const EarlierProcesses& earlier) : earlier_(earlier) {}
  CallbackTable(const CallbackTable&) = delete;  // a copy of the model would refer to another model
  CallbackTable& operator=(const CallbackTable&) = delete;

  // The callback at the address. Makes one when none is known.
  ObjectId at(ProcessId process, ros2::Handle address);
  // The callback at the address. It stays as it is if it has this owner, gets this owner if it had none, or is a new
  // one.
  ObjectId add(ProcessId process, ros2::Handle address, Owner owner, ObjectId owner_id);
  bool belongs_to(ProcessId process, ros2::Handle address, Owner owner, ObjectId owner_id) const;
  void name(ProcessId process, ros2::Handle address, std::string_view symbol);
  // A new callback like the newest of owner `from`, for `to`.
  void move(ProcessId process, Owner owner, ObjectId from, ObjectId to);
  // No callback has the address any more.
  void end(ProcessId process, ros2::Handle address) { index_.erase({process, address}); }

  const std::vector<CallbackObject>& all() const { return callbacks_; }

 private:
  ObjectId find(ProcessId process, ros2::Handle address) const;
  ObjectId append(CallbackObject callback);

  const EarlierProcesses& earlier_;
  std::vector<CallbackObject> callbacks_;
  HandleIndex<ObjectId> index_;
};

}  // namespace tracing
