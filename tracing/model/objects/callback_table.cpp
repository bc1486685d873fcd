// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/objects/callback_table.hpp"

#include <utility>

namespace tracing {

namespace {

// LTTng-UST records NULL as this text.
constexpr std::string_view kNullString = "(null)";

}  // namespace

ObjectId CallbackTable::find(ProcessId process, ros2::Handle address) const {
  const ObjectId* const found = earlier_.find(index_, process, address);
  return found == nullptr ? kNoObject : *found;
}

ObjectId CallbackTable::at(ProcessId process, ros2::Handle address) {
  const ObjectId id = find(process, address);
  return id != kNoObject ? id : append({process, address, Owner::kUnknown, kNoObject, ""});
}

ObjectId CallbackTable::add(ProcessId process, ros2::Handle address, Owner owner, ObjectId owner_id) {
  const ObjectId id = find(process, address);
  if (id != kNoObject && callbacks_[id].owner == owner && callbacks_[id].owner_id == owner_id) {
    return id;
  }
  if (id != kNoObject && callbacks_[id].owner == Owner::kUnknown) {
    // The callback ran before the state dump announced it.
    callbacks_[id].owner = owner;
    callbacks_[id].owner_id = owner_id;
    return id;
  }
  return append({process, address, owner, owner_id, ""});
}

bool CallbackTable::belongs_to(ProcessId process, ros2::Handle address, Owner owner, ObjectId owner_id) const {
  const ObjectId id = find(process, address);
  return id != kNoObject && callbacks_[id].owner == owner && callbacks_[id].owner_id == owner_id;
}

void CallbackTable::name(ProcessId process, ros2::Handle address, std::string_view symbol) {
  ObjectId id = at(process, address);  // its *_callback_added may not be in the trace
  if (symbol == kNullString || callbacks_[id].symbol == symbol) {
    return;
  }
  if (!callbacks_[id].symbol.empty()) {  // a new callback of an object that looks like the one before
    id = append(CallbackObject(callbacks_[id]));
  }
  callbacks_[id].symbol = symbol;
}

void CallbackTable::move(ProcessId process, Owner owner, ObjectId from, ObjectId to) {
  for (ObjectId id = 0; id < callbacks_.size(); ++id) {
    const CallbackObject& callback = callbacks_[id];
    if (callback.process != process || find(process, callback.address) != id) {
      continue;
    }
    if (callback.owner != owner || callback.owner_id != from) {
      continue;
    }
    CallbackObject moved = callback;
    moved.owner_id = to;
    append(std::move(moved));
    return;
  }
}

ObjectId CallbackTable::append(CallbackObject callback) {
  const ObjectId id = static_cast<ObjectId>(callbacks_.size());
  index_[{callback.process, callback.address}] = id;
  callbacks_.push_back(std::move(callback));
  return id;
}

}  // namespace tracing
