// SPDX-License-Identifier: Apache-2.0
// Reads traces: the events and losses of one or several directories, in the order of time.
//
//   launch_trace::Reader reader("/home/me/.ros/tracing/run");
//   for (const launch_trace::Item& item : reader) {
//     if (const launch_trace::Event* event = item.event()) std::cout << event->time_ns() << ' ' << event->name() <<
//     '\n';
//   }
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "launch_trace/event.hpp"

namespace launch_trace {

// A trace can't be read, or not to its end. what() is one line; remedy() says what to do, and may be empty.
class Error : public std::runtime_error {
 public:
  Error(const std::string& what, std::string remedy) : std::runtime_error(what), remedy_(std::move(remedy)) {}
  const std::string& remedy() const { return remedy_; }

 private:
  std::string remedy_;
};

// An event or a loss; the other one is null.
class Item {
 public:
  const Event* event() const { return event_; }
  const Loss* loss() const { return loss_; }

 private:
  friend struct Access;
  const Event* event_ = nullptr;
  const Loss* loss_ = nullptr;
};

struct Options {
  // What can be read beside damage is always read. Whether the end then throws an Error; otherwise only
  // Reader::damage() tells it.
  bool damage_is_error = true;
};

// Not for several threads at once; several readers are independent.
class Reader {
 public:
  // Finds all traces at and below the directories. Throws Error when there is none or none can be read.
  explicit Reader(const std::filesystem::path& directory, Options options = {});
  explicit Reader(const std::vector<std::filesystem::path>& directories, Options options = {});
  ~Reader();
  Reader(Reader&&) noexcept;
  Reader& operator=(Reader&&) noexcept;

  // The next item, valid until the next call; null at the end. Throws Error as Options say, once.
  const Item* next();

  // For range-based loops, which go on where next() stands.
  class Iterator;
  Iterator begin();
  std::default_sentinel_t end() const { return {}; }

  // What could not be read so far, a line each, with the file and the byte.
  const std::vector<std::string>& damage() const;
  // Directories with files that a program was writing when the reading began. Such a trace ends with the last packet
  // that was complete.
  const std::vector<std::filesystem::path>& open_directories() const;
  // Events of such a trace were left out so far, because the tracer has not described them yet. LTTng does so when a
  // traced program ends or the session is stopped.
  bool lacks_descriptions() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

class Reader::Iterator {
 public:
  using iterator_concept = std::input_iterator_tag;
  using value_type = Item;
  using difference_type = std::ptrdiff_t;

  const Item& operator*() const { return *item_; }
  const Item* operator->() const { return item_; }
  Iterator& operator++() {
    item_ = reader_->next();
    return *this;
  }
  void operator++(int) { ++*this; }
  bool operator==(std::default_sentinel_t) const { return item_ == nullptr; }

 private:
  friend class Reader;
  explicit Iterator(Reader& reader) : reader_(&reader), item_(reader.next()) {}
  Reader* reader_;
  const Item* item_;
};

inline Reader::Iterator Reader::begin() {
  return Iterator(*this);
}

}  // namespace launch_trace
