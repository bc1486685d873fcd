// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/objects/callback_groups.hpp"

namespace tracing {

void CallbackGroups::on(const Origin& origin, const ros2::CaretEvent& event) {
  using Kind = ros2::CaretEvent::Kind;
  const ProcessId process = origin.process;
  switch (event.kind) {
    case Kind::kExecutor: {
      const ObjectId id = executor(process, event.first);
      if (!event.text.empty()) {
        executors_[id].kind = event.text;
      }
      if (event.second != 0) {
        const HandleKey collector{process, event.second};
        executor_of_collector_[collector] = id;
        for (const ObjectId waiting : waiting_groups_[collector]) {
          groups_[waiting].executor = id;
        }
        waiting_groups_.erase(collector);
      }
      break;
    }
    case Kind::kExecutorGroup: {
      GroupObject& known = groups_[group(process, event.second)];
      known.kind = event.text;
      known.executor = executor(process, event.first);
      break;
    }
    case Kind::kCollectorGroup: {
      const ObjectId id = group(process, event.second);
      groups_[id].kind = event.text;
      if (const ObjectId* const found = executor_of_collector_.find({process, event.first})) {
        groups_[id].executor = *found;
      } else {
        waiting_groups_[{process, event.first}].push_back(id);
      }
      break;
    }
    case Kind::kTimer:
      add_member(origin, event, Owner::kTimer, model_.timer(process, event.second));
      break;
    case Kind::kSubscription:
      add_member(origin, event, Owner::kSubscription, model_.subscription(process, event.second));
      break;
    case Kind::kService:
      add_member(origin, event, Owner::kService, model_.service(process, event.second));
      break;
    case Kind::kClient:
      add_member(origin, event, Owner::kClient, model_.client(process, event.second));
      break;
    case Kind::kSimulatedTime:
      simulated_times_.push_back({process, origin.time_ns, event.number});
      break;
    case Kind::kSourceTimestamp:
      break;
  }
}

ObjectId CallbackGroups::executor(ProcessId process, ros2::Handle address) {
  if (const ObjectId* const known = executor_index_.find({process, address})) {
    return *known;
  }
  const auto id = static_cast<ObjectId>(executors_.size());
  executor_index_[{process, address}] = id;
  executors_.push_back({process, address, {}});
  return id;
}

ObjectId CallbackGroups::group(ProcessId process, ros2::Handle address) {
  if (const ObjectId* const known = group_index_.find({process, address})) {
    return *known;
  }
  const auto id = static_cast<ObjectId>(groups_.size());
  group_index_[{process, address}] = id;
  groups_.push_back({process, address, kNoObject, {}});
  return id;
}

void CallbackGroups::add_member(const Origin& origin, const ros2::CaretEvent& event, Owner owner, ObjectId id) {
  if (id != kNoObject) {
    group_of_[{owner, id}] = group(origin.process, event.first);
  }
}

ObjectId CallbackGroups::group_of(const CallbackObject& callback) const {
  const ObjectId owner = callback.owner == Owner::kSubscription ? model_.subscription_of(callback) : callback.owner_id;
  const auto found = group_of_.find({callback.owner, owner});
  return found == group_of_.end() ? kNoObject : found->second;
}

}  // namespace tracing
