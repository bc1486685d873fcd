// SPDX-License-Identifier: Apache-2.0
// A RosClient for tests: notes the requests, and answers when the test says so.
#pragma once

#include <fmt/format.h>

#include <list>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "launcher/ros/ros_client.hpp"

namespace test_support {

class FakeRosClient : public launch::RosClient {
 public:
  explicit FakeRosClient(launch::EventLoop& loop) : loop_(loop) {}

  [[nodiscard]] launch::EventLoop::SourcePtr ask(const launch::RosRequest& request, const launch::Environment&,
                                                 launch::Duration, Done done) override {
    asked.push_back(text_of(request));
    auto pending = std::make_shared<Pending>(Pending{asked.back(), std::move(done), false});
    pending_.push_back(pending);
    if (const auto script = scripts_.find(asked.back()); script != scripts_.end()) {
      loop_.post([this, text = asked.back(), answer = script->second] { answer_pending(text, answer); });
    }
    return std::make_unique<Handle>(pending);
  }

  void close() override { closed = true; }

  // Every request of this text is answered at once with `answer`.
  void script(const std::string& text, launch::RosAnswer answer) { scripts_[text] = std::move(answer); }

  // Answers the oldest pending request of this text; false when there is none.
  bool answer_pending(const std::string& text, const launch::RosAnswer& answer) {
    for (auto place = pending_.begin(); place != pending_.end(); ++place) {
      const auto pending = *place;
      if (!pending->cancelled && pending->text == text) {
        pending_.erase(place);
        pending->done(answer);
        return true;
      }
    }
    return false;
  }

  // Gives an answer of several to each pending request of this text. Returns how many there are.
  int tell(const std::string& text, const launch::RosAnswer& answer) {
    const auto told = pending_;
    int count = 0;
    for (const auto& pending : told) {
      if (!pending->cancelled && pending->text == text) {
        ++count;
        pending->done(answer);
      }
    }
    return count;
  }

  // Reports a change to the watches of a node's state. Returns how many there are.
  int change_state(const std::string& node, const std::string& from, const std::string& to) {
    launch::RosAnswer answer;
    answer.ok = true;
    answer.previous_state = from;
    answer.state = to;
    const auto told = pending_;
    int count = 0;
    for (const auto& pending : told) {
      if (!pending->cancelled && pending->text == text_of(launch::WatchTransitions{node})) {
        ++count;
        pending->done(answer);
      }
    }
    return count;
  }

  // "load /c talker", "change /n configure", or what the request waits for.
  static std::string text_of(const launch::RosRequest& request) {
    if (const auto* const load = std::get_if<launch::LoadNode>(&request)) {
      return fmt::format("load {} {}", load->container, load->node.name);
    }
    if (const auto* const change = std::get_if<launch::ChangeState>(&request)) {
      return fmt::format("change {} {}", change->node, change->transition);
    }
    return launch::describe(request);
  }

  static launch::RosAnswer loaded(const std::string& node) {
    launch::RosAnswer answer;
    answer.ok = true;
    answer.node = node;
    return answer;
  }
  static launch::RosAnswer refused(const std::string& error) {
    launch::RosAnswer answer;
    answer.error = error;
    return answer;
  }

  std::vector<std::string> asked;
  bool closed = false;

 private:
  struct Pending {
    std::string text;
    Done done;
    bool cancelled;
  };
  class Handle : public launch::EventLoop::Source {
   public:
    explicit Handle(std::shared_ptr<Pending> pending) : pending_(std::move(pending)) {}
    ~Handle() override { pending_->cancelled = true; }

   private:
    std::shared_ptr<Pending> pending_;
  };

  launch::EventLoop& loop_;
  std::list<std::shared_ptr<Pending>> pending_;
  std::map<std::string, launch::RosAnswer> scripts_;
};

}  // namespace test_support
