// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/analysis/join/event_join.hpp"

namespace tracing {

void EventJoin::on(const Origin& origin, const ros2::CallbackStart& event) {
  ThreadState& running = thread(origin);
  const ObjectId id = model_.callback(origin.process, event.callback);
  callbacks_.start({origin.process, origin.vtid}, running.callbacks,
                   {event.callback, id, origin.time_ns, event.is_intra_process});
  messages_.on_callback(origin, running, id, event.is_intra_process);
  running.executed = 0;  // what it takes from now on is not taken by the executor
  waits_.begin_callback(origin, running.waits, id);
  if (model_.callbacks()[id].owner == CallbackObject::Owner::kService) {
    calls_.begin_work(origin);
  }
}

void EventJoin::on(const Origin& origin, const ros2::CallbackEnd& event) {
  ThreadState& running = thread(origin);
  messages_.go_on(origin, running);
  const std::optional<ObjectId> ended =
      callbacks_.end({origin.process, origin.vtid}, running.callbacks, event.callback, origin.time_ns);
  if (ended) {
    waits_.end_callback(origin, *ended);
    if (model_.callbacks()[*ended].owner == CallbackObject::Owner::kService) {
      calls_.end_work(origin);
    }
  }
}

void EventJoin::on(const Origin& origin, const ros2::RmwSendResponse& event) {
  calls_.on(origin, event);
  executions_.end(thread(origin).execution, ros2::ExecutionEvent::Kind::kService, origin.time_ns);
}

// The model wants to know whose services rclcpp names next.
void EventJoin::on(const Origin& origin, const ros2::RclLifecycleStateMachineInit& event) {
  model_.on(origin, event);
  lifecycle_.on(origin, event);
}

void EventJoin::on(const Origin& origin, const ros2::RclcppExecutorGetNextReady&) {
  ThreadState& spinning = thread(origin);
  messages_.go_on(origin, spinning);
  spinning.execution.reset();
  const ThreadId thread{origin.process, origin.vtid};
  const bool is_first = spinning.waits.looked_ns == 0;
  if (const std::optional<std::int64_t> begin_ns = waits_.look(origin, spinning.waits)) {
    sink_.on_executor_wait({thread, *begin_ns, origin.time_ns});
  } else if (!is_first) {
    sink_.on_executor_look({thread, origin.time_ns});
  }
}

void EventJoin::on(const Origin& origin, const ros2::RclcppExecutorWaitForWork&) {
  ThreadState& spinning = thread(origin);
  messages_.go_on(origin, spinning);
  spinning.execution.reset();
  messages_.give_to_none(origin, spinning);
  spinning.executed = 0;
  waits_.wait(origin, spinning.waits);
}

void EventJoin::on(const Origin& origin, const ros2::RclcppExecutorExecute& event) {
  ThreadState& executing = thread(origin);
  executing.execution.reset();
  messages_.on(origin, executing, event);
}

void EventJoin::on_execution(const Origin& origin, const ros2::ExecutionEvent& event) {
  using Kind = ros2::ExecutionEvent::Kind;
  ThreadState& running = thread(origin);
  const ThreadId thread{origin.process, origin.vtid};
  if (event.kind == Kind::kClientCallbackStart) {
    const ObjectId callback = model_.client_callback(origin.process, event.handle);
    callbacks_.start(thread, running.callbacks, {event.handle, callback, origin.time_ns, false});
  } else if (event.kind == Kind::kClientCallbackEnd) {
    callbacks_.end(thread, running.callbacks, event.handle, origin.time_ns);
    executions_.end(running.execution, Kind::kClient, origin.time_ns);
  } else {
    executions_.start(running.execution, origin, event);
  }
}

void EventJoin::on_thread_state(const ThreadInterval& interval) {
  callbacks_.add(interval, threads_[interval.thread].callbacks);
  sink_.on_thread_state(interval);
}

void EventJoin::on_allocation(const Origin& origin, std::uint64_t bytes) {
  const std::vector<ActiveCallback>& running = thread(origin).callbacks.running;
  sink_.on_allocation(
      {{origin.process, origin.vtid}, origin.time_ns, bytes, running.empty() ? kNoObject : running.back().callback});
}

void EventJoin::on_end(const Origin& origin, const ros2::ObjectEnd& end) {
  last_ns_ = origin.time_ns;
  if (end.kind == ros2::ObjectEnd::Kind::kRclLifecycleStateMachine) {
    lifecycle_.end(origin, end.handle);
  } else if (end.kind == ros2::ObjectEnd::Kind::kRmwClient) {
    calls_.end_client(model_.rmw_client(origin.process, end.handle), origin.time_ns);
  }
  model_.on(origin, end);
}

void EventJoin::finish() {
  for (auto& [id, state] : threads_) {
    callbacks_.abandon(id, state.callbacks, last_ns_);
    messages_.give_to_none({last_ns_, id.process, id.vtid}, state);
  }
  threads_.clear();
  lifecycle_.finish(last_ns_);
  messages_.finish();
  calls_.finish(last_ns_);
}

}  // namespace tracing
