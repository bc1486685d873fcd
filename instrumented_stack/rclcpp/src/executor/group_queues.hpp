// SPDX-License-Identifier: Apache-2.0
// What is ready to be executed, by callback groups: the queues of an EventsCBGExecutor, and the threads that wait for
// them.
//
// A group has a queue of its entities that are ready, in the order in which they became ready. Of the groups that may
// be taken from, the one whose first entity has been ready longest is next. An entity has one place in its queue,
// however much has arrived for it, and goes to the end of the queue when it is taken. So each ready entity is overtaken
// by any other one at most twice, and the queues do not grow with what arrives.
#pragma once

#include <rcl/timer.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "executor/sleeping_threads.hpp"
#include "executor/timer_queue.hpp"
#include "rclcpp/any_executable.hpp"
#include "rclcpp/detail/ready_entity.hpp"
#include "rclcpp/macros.hpp"

namespace rclcpp {

// Thread safe, but for the members of Group and Entity, which belong to this class.
class GroupQueues {
 public:
  struct Entity;

  struct Group {
    explicit Group(const CallbackGroup::SharedPtr& served)
        : group(served), is_exclusive(served->type() == CallbackGroupType::MutuallyExclusive) {}

    const CallbackGroup::WeakPtr group;
    const bool is_exclusive;
    std::list<Entity*> ready;
    bool is_listed = false;
    bool is_running = false;         // a callback of this exclusive group runs in a thread of the executor
    bool is_busy_elsewhere = false;  // a callback that another executor has begun
    bool is_removed = false;
  };

  struct Entity : std::enable_shared_from_this<Entity> {
    Entity(detail::AnyEntity served, std::shared_ptr<Group> its_group)
        : entity(std::move(served)), group(std::move(its_group)) {}
    RCLCPP_DISABLE_COPY(Entity)

    const detail::AnyEntity entity;
    const std::shared_ptr<Group> group;
    std::uint64_t turn = 0;  // the order in which entities became ready; 0: not ready
    std::size_t count = 0;   // of what has arrived
    bool is_removed = false;
    std::list<Entity*> unqueued{this};  // empty while it is in the queue of its group
    const std::list<Entity*>::iterator node = unqueued.begin();
    // Of a timer:
    std::shared_ptr<const rcl_timer_t> timer;
    std::size_t timer_index = 0;
    // Of a waitable: which of its entities had how many events, in the order of their coming.
    std::vector<std::pair<int, std::size_t>> events;
    std::mutex take_mutex;  // held while its data is taken
  };

  // What one thread executes. The group is given back by the next wait() or take() with this work, or at its end.
  class Work {
   public:
    explicit Work(GroupQueues& queues) : queues_(queues) {}
    ~Work();
    RCLCPP_DISABLE_COPY(Work)

    // Runs the callback and releases what it has used, but for the place of the group.
    template <typename ExecuteT>
    void execute(ExecuteT execute_chosen) {
      if (take_data()) {
        execute_chosen(executable_);
      }
      release();
    }

   private:
    friend class GroupQueues;
    // False if the timer was canceled meanwhile.
    bool take_data();
    void release();

    GroupQueues& queues_;
    AnyExecutable executable_;
    std::shared_ptr<Group> group_;
    std::shared_ptr<Entity> waitable_;
    int event_ = 0;
  };

  GroupQueues() = default;
  RCLCPP_DISABLE_COPY(GroupQueues)

  // Something has arrived for the entity. Called by threads of the middleware.
  void add(const std::shared_ptr<Entity>& entity, std::size_t count, int event = 0);
  // A timer may be due earlier than it was.
  void timers_changed();
  // Replaces the timers. They are the entities whose `timer` is set.
  void set_timers(std::vector<std::shared_ptr<Entity>> timers);
  // What is removed is not executed any more, apart from what a thread executes already.
  void remove(const std::vector<std::shared_ptr<Entity>>& entities);
  void remove(Group& group);
  // Groups that were busy in another executor may have become free.
  void look_again();

  // Gets the next work that is ready, if there is some.
  bool take(Work& work);
  // Waits for work. Returns false when `timeout` is over (negative: never), or if an interruption came after the
  // `seen` ones.
  bool wait(Work& work, std::chrono::nanoseconds timeout, std::uint64_t seen);
  std::uint64_t interruptions() const { return interruptions_; }
  // Ends all waits.
  void interrupt();

  // While one lives, take() finds what was ready when it was made, and nothing else.
  class OnlyWhatIsReady {
   public:
    explicit OnlyWhatIsReady(GroupQueues& queues);
    ~OnlyWhatIsReady();
    RCLCPP_DISABLE_COPY(OnlyWhatIsReady)

   private:
    GroupQueues& queues_;
  };

 private:
  struct Listed {
    std::uint64_t turn;
    Group* group;
  };
  struct Arrival {
    std::shared_ptr<Entity> entity;
    std::size_t count;
    int event;
  };
  // What locked sections have taken out. Its end may call this class, so it is released without the lock.
  struct Released {
    std::vector<CallbackGroup::SharedPtr> groups;
    std::vector<std::shared_ptr<void>> entities;
  };

  // These with the mutex held.
  void arrived(Entity& entity, std::size_t count, int event);
  void queue(Entity& entity);
  void unqueue(Entity& entity);
  void list(Group& group);
  void finish(Work& work);
  void queue_due_timers();
  bool take_next(Work& work, Released& released);
  // Puts the first entity of the group that can be executed into `executable`. Those before it are dropped. False if
  // there is none.
  bool find_first(Group& group, AnyExecutable& executable, Released& released);
  void take_first(Group& group, Work& work);
  // The caller notifies the result.
  SleepingThreads::Thread* wake_if_needed();

  std::mutex mutex_;
  std::vector<Listed> listed_;  // groups that have something to execute: a heap with the oldest one first
  std::vector<Group*> busy_elsewhere_;
  std::uint64_t last_turn_ = 0;
  TimerQueue timers_;
  std::vector<std::shared_ptr<Entity>> timer_entities_;  // with the indices of timers_
  std::vector<std::size_t> due_;
  std::atomic_bool are_times_changed_{false};
  bool is_frozen_ = false;
  std::vector<Arrival> arrivals_;  // while it is frozen
  std::atomic<std::uint64_t> interruptions_{0};
  SleepingThreads threads_;
};

}  // namespace rclcpp
