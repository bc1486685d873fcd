// SPDX-License-Identifier: Apache-2.0
// Tells several sinks the same.
#pragma once

#include <vector>

#include "tracing/model/execution/execution_sink.hpp"

namespace tracing {

class SinkList : public ExecutionSink {
 public:
  void add(ExecutionSink* sink) { sinks_.push_back(sink); }

  void on_callback_begin(const CallbackInstance& instance) override {
    tell(&ExecutionSink::on_callback_begin, instance);
  }
  void on_callback(const CallbackInstance& instance) override { tell(&ExecutionSink::on_callback, instance); }
  void on_publication(const Publication& publication) override { tell(&ExecutionSink::on_publication, publication); }
  void on_message(const MessageFlow& message) override { tell(&ExecutionSink::on_message, message); }
  void on_message_link(const MessageLink& link) override { tell(&ExecutionSink::on_message_link, link); }
  void on_call(const ServiceCall& call) override { tell(&ExecutionSink::on_call, call); }
  void on_open_call(const ServiceCall& call) override { tell(&ExecutionSink::on_open_call, call); }
  void on_executor_wait(const ExecutorWait& wait) override { tell(&ExecutionSink::on_executor_wait, wait); }
  void on_executor_look(const ExecutorLook& look) override { tell(&ExecutionSink::on_executor_look, look); }
  void on_lifecycle_state(const LifecycleInterval& state) override { tell(&ExecutionSink::on_lifecycle_state, state); }
  void on_thread_state(const ThreadInterval& interval) override { tell(&ExecutionSink::on_thread_state, interval); }
  void on_allocation(const Allocation& allocation) override { tell(&ExecutionSink::on_allocation, allocation); }

 private:
  template <class Fact>
  void tell(void (ExecutionSink::*what)(const Fact&), const Fact& fact) {
    for (ExecutionSink* sink : sinks_) {
      (sink->*what)(fact);
    }
  }

  std::vector<ExecutionSink*> sinks_;
};

}  // namespace tracing
