// SPDX-License-Identifier: Apache-2.0
#ifndef TRACETOOLS__OBJECT_STATE_HPP_
#define TRACETOOLS__OBJECT_STATE_HPP_

#include <cstddef>
#include <functional>
#include <list>
#include <mutex>
#include <unordered_map>
#include <vector>

/// The init events of every living object of this process, kept so that they can be recorded again for a session that
/// starts late: a state dump. Without it the runtime events of such a session would speak of addresses that nothing in
/// its trace explains.
///
/// An init event belongs to one or more objects and is forgotten at the end of any of them. Events are recorded again
/// in the order in which they came, by the thread that asks. All functions may be called from any thread.
namespace tracetools {

/// Objects of different kinds may have one address: a struct and its first member.
enum class ObjectKind {
  kContext,
  kNode,
  kRmwPublisher,
  kPublisher,
  kRmwSubscription,
  kSubscription,
  kRclcppSubscription,
  kRmwService,
  kService,
  kRmwClient,
  kClient,
  kTimer,
  kCallback,
  kStateMachine,
  kIntraProcessBuffer,
  kRingBuffer,
};

struct ObjectKey {
  ObjectKind kind;
  const void* address;
  bool operator==(const ObjectKey&) const = default;
};

class ObjectState {
 public:
  /// That of the process. It is never destroyed: threads may fire events until the very end.
  static ObjectState& instance();

  /// Keeps an init event of `objects`, at least one; `record` writes it once more. It takes the place of the event of
  /// the same `name` about the same first object. Call it before recording the event, so that none is missed: an event
  /// recorded twice around the start of a session is harmless.
  ///
  /// `name` must live as long as the process; an event without name (null) takes no other's place.
  void keep(std::vector<ObjectKey> objects, const char* name, std::function<void()> record);

  /// The object ends. Call it before recording that.
  void forget(ObjectKey object);

  /// Records all events again, between ros2_ext:state_dump_begin and state_dump_end; nothing if there are none. Objects
  /// neither begin nor end meanwhile: who tries waits.
  void record_again();

 private:
  struct InitEvent {
    std::vector<ObjectKey> objects;
    const char* name;
    std::function<void()> record;
  };
  using InitEvents = std::list<InitEvent>;

  struct HashKey {
    std::size_t operator()(const ObjectKey& key) const noexcept;
  };

  void erase(InitEvents::iterator event);

  std::mutex mutex_;
  InitEvents events_;
  std::unordered_map<ObjectKey, std::vector<InitEvents::iterator>, HashKey> of_object_;
};

}  // namespace tracetools

#endif  // TRACETOOLS__OBJECT_STATE_HPP_
