// SPDX-License-Identifier: Apache-2.0
#ifndef TRACETOOLS__OBJECT_STATE_HPP_
#define TRACETOOLS__OBJECT_STATE_HPP_

#include <cstddef>
#include <functional>
#include <list>
#include <mutex>
#include <unordered_map>
#include <vector>

/// The init events of every living object of this process. They are kept so that they can be recorded again for a
/// session that starts late: a state dump. Without it, the runtime events of such a session would contain addresses
/// that nothing in its trace explains.
///
/// An init event belongs to one or more objects and is forgotten at the end of any of them. Events are recorded again
/// in their original order, by the calling thread. All functions may be called from any thread.
namespace tracetools {

/// Objects of different kinds may share an address: a struct and its first member.
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
  /// The state of the process. It is never destroyed, because threads may fire events until the very end.
  static ObjectState& instance();

  /// Keeps an init event of `objects`, at least one; `record` writes it again. It replaces the event of the same `name`
  /// about the same first object. Call it before recording the event, so that a new session does not miss it. If a
  /// session starts meanwhile, the event is recorded twice, which is harmless.
  ///
  /// `name` must live as long as the process. An event without a name (null) replaces no other.
  void keep(std::vector<ObjectKey> objects, const char* name, std::function<void()> record);

  /// The object ends. Call this before recording the end.
  void forget(ObjectKey object);

  /// Records all events again, between ros2_ext:state_dump_begin and state_dump_end; does nothing if there are none.
  /// Objects neither begin nor end meanwhile: threads that try must wait.
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
