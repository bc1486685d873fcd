// SPDX-License-Identifier: Apache-2.0
// The handlers of conditions on what nodes do (on_silence, on_memory and others): each is watched until it is removed.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/conditions/condition_watch.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/process/output/output_router.hpp"
#include "launcher/visit/event_handler.hpp"

namespace launch {

// A condition has begun to hold, or holds no longer.
struct ConditionEvent {
  tracing::LiveCondition condition;
  tracing::ConditionChange change;
  SourceRange where;
};

class ConditionHandlers {
 public:
  struct Callbacks {
    std::function<void(LogLevel level, const std::string& text)> message;
    std::function<void(const ConditionEvent& event)> changed;
  };

  // `invoke` gets the handlers to visit, `fail` an error that prevents all conditions from being known. The loop must
  // outlive this object.
  ConditionHandlers(EventLoop& loop, std::function<void(std::vector<Invocation>)> invoke,
                    std::function<void(const LaunchError&)> fail)
      : loop_(loop), invoke_(std::move(invoke)), fail_(std::move(fail)) {}

  // The watches of what is recorded, and of what processes use. They must outlive this object.
  void use(ConditionWatch& recorded, ConditionWatch& processes, Callbacks callbacks);

  // Watches the condition of an OnCondition. Without a watch that is an error.
  void add(EventHandler handler);
  // Forgets the handlers of that name; false when there is none.
  bool remove(const std::string& name);
  void clear();
  // Before the system stops, and after it goes on: what nodes do not do meanwhile is no fault of theirs.
  void suspend(bool stops);
  // Ends the watch for good.
  void shutdown();

 private:
  struct Watched {
    std::shared_ptr<const EventHandler> handler;
    std::optional<Duration> visited;  // when, the last time
    EventLoop::SourcePtr later;       // visits it after its cool_down, if the condition holds then
    bool holds = false;
    // The watch counts anew. If it says until then that the condition holds, it has held all the time.
    std::optional<Duration> goes_on_until = std::nullopt;
    bool owes_visit = false;  // which its cool_down has put off
  };

  ConditionWatch& watch_of(const EventHandler& handler) const;
  void on_report(const tracing::ConditionReport& report);
  // Of what is recorded: the watch counts anew, and says nothing of what has ceased to hold meanwhile.
  void begin_anew();
  void on_change(tracing::ConditionId id, const tracing::ConditionChange& change);
  void on_unseen(const tracing::NameNotSeen& unseen);
  void on_failure(const tracing::WatchFailed& failed);
  void visit(tracing::ConditionId id, const tracing::ConditionChange& change);

  EventLoop& loop_;
  std::function<void(std::vector<Invocation>)> invoke_;
  std::function<void(const LaunchError&)> fail_;
  ConditionWatch* recorded_watch_ = nullptr;
  ConditionWatch* process_watch_ = nullptr;
  Callbacks callbacks_;
  std::map<tracing::ConditionId, Watched> handlers_;
  tracing::ConditionId last_id_ = 0;
  bool recorded_ = false;
};

}  // namespace launch
