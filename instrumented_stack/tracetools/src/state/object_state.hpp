// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <list>
#include <mutex>
#include <unordered_map>
#include <vector>

#include "state/init_event.hpp"
#include "state/session_memory.hpp"

// The objects that live in this process, as their init events described them. Runtime events identify objects only by
// address, so a session that starts now needs these events.
//
// A session has each init event once: when it is fired, or in a dump into this session alone. All functions may be
// called from any thread.
namespace tracetools {

class ObjectState {
 public:
  // The state of the process. It is never destroyed, because threads may fire events until the very end.
  static ObjectState& instance();

  // Keeps an init event, and records it into all sessions that want it. It replaces the event of the same name about
  // the same first object.
  void keep(InitEvent event);
  // Keeps an event that only state dumps record.
  void keep_for_dumps(InitEvent event);

  // The object ends. Call this before recording the end.
  void forget(ObjectKey object);

  // Records the events that the session does not have, between ros2_ext:state_dump_begin and state_dump_end. A session
  // that starts has none. A session that resumes lacks those that were fired while it paused. A session that asks
  // again without a pause gets all again. Does nothing if the session records none of them, or wants no dumps. Objects
  // neither begin nor end meanwhile: threads that try must wait. Returns the number of these events.
  // `lives`: LTTng does not free the session meanwhile, whether it records events or not.
  std::size_t dump_to(Session* session, bool lives);

 private:
  using InitEvents = std::list<InitEvent>;

  struct HashKey {
    std::size_t operator()(const ObjectKey& key) const noexcept;
  };

  InitEvent& insert(InitEvent event);
  void erase(InitEvents::iterator event);
  void record_live(InitEvent& event);
  // True if the event's tracepoint is the reference of a session from now on.
  bool record_live(InitEvent& event, const ProbesInUse& probes);

  std::mutex mutex_;
  InitEvents events_;
  std::uint64_t last_number_ = 0;
  std::unordered_map<ObjectKey, std::vector<InitEvents::iterator>, HashKey> of_object_;
  SessionMemory sessions_;
};

}  // namespace tracetools
