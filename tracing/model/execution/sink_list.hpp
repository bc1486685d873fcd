// SPDX-License-Identifier: Apache-2.0
// Tells several sinks the same. Most of them want to know little of it, so their types are known here: what a sink does
// not override costs nothing.
#pragma once

#include <tuple>

#include "tracing/model/execution/execution_sink.hpp"

namespace tracing {

// The types must be those of the objects, not of their bases.
template <class... Sinks>
class SinkList final : public ExecutionSink {
 public:
  // In this order. `other` may be null.
  SinkList(Sinks&... sinks, ExecutionSink* other) : sinks_(sinks...), other_(other) {}

  void on_callback_begin(const CallbackInstance& instance) override {
    each([&]<class Sink>(Sink& sink) { sink.Sink::on_callback_begin(instance); });
    if (other_ != nullptr) {
      other_->on_callback_begin(instance);
    }
  }
  void on_callback(const CallbackInstance& instance) override {
    each([&]<class Sink>(Sink& sink) { sink.Sink::on_callback(instance); });
    if (other_ != nullptr) {
      other_->on_callback(instance);
    }
  }
  void on_publication(const Publication& publication) override {
    each([&]<class Sink>(Sink& sink) { sink.Sink::on_publication(publication); });
    if (other_ != nullptr) {
      other_->on_publication(publication);
    }
  }
  void on_message(const MessageFlow& message) override {
    each([&]<class Sink>(Sink& sink) { sink.Sink::on_message(message); });
    if (other_ != nullptr) {
      other_->on_message(message);
    }
  }
  void on_message_link(const MessageLink& link) override {
    each([&]<class Sink>(Sink& sink) { sink.Sink::on_message_link(link); });
    if (other_ != nullptr) {
      other_->on_message_link(link);
    }
  }
  void on_call(const ServiceCall& call) override {
    each([&]<class Sink>(Sink& sink) { sink.Sink::on_call(call); });
    if (other_ != nullptr) {
      other_->on_call(call);
    }
  }
  void on_open_call(const ServiceCall& call) override {
    each([&]<class Sink>(Sink& sink) { sink.Sink::on_open_call(call); });
    if (other_ != nullptr) {
      other_->on_open_call(call);
    }
  }
  void on_executor_wait(const ExecutorWait& wait) override {
    each([&]<class Sink>(Sink& sink) { sink.Sink::on_executor_wait(wait); });
    if (other_ != nullptr) {
      other_->on_executor_wait(wait);
    }
  }
  void on_executor_look(const ExecutorLook& look) override {
    each([&]<class Sink>(Sink& sink) { sink.Sink::on_executor_look(look); });
    if (other_ != nullptr) {
      other_->on_executor_look(look);
    }
  }
  void on_lifecycle_state(const LifecycleInterval& state) override {
    each([&]<class Sink>(Sink& sink) { sink.Sink::on_lifecycle_state(state); });
    if (other_ != nullptr) {
      other_->on_lifecycle_state(state);
    }
  }
  void on_thread_state(const ThreadInterval& interval) override {
    each([&]<class Sink>(Sink& sink) { sink.Sink::on_thread_state(interval); });
    if (other_ != nullptr) {
      other_->on_thread_state(interval);
    }
  }
  void on_callback_wait(const CallbackWait& wait) override {
    each([&]<class Sink>(Sink& sink) { sink.Sink::on_callback_wait(wait); });
    if (other_ != nullptr) {
      other_->on_callback_wait(wait);
    }
  }
  void on_allocation(const Allocation& allocation) override {
    each([&]<class Sink>(Sink& sink) { sink.Sink::on_allocation(allocation); });
    if (other_ != nullptr) {
      other_->on_allocation(allocation);
    }
  }

 private:
  template <class Tell>
  void each(const Tell& tell) {
    std::apply([&](Sinks&... sinks) { (tell(sinks), ...); }, sinks_);
  }

  std::tuple<Sinks&...> sinks_;
  ExecutionSink* other_;
};

}  // namespace tracing
