// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/system_test/message_faults.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <memory>
#include <string>
#include <system_error>
#include <variant>

#include "base/environment/own_prefix.hpp"
#include "launcher/visit/process_table.hpp"
#include "rmw_message_faults/fault_table.hpp"

namespace launch {

namespace {

namespace table = rmw_message_faults;

table::Kind kind_of(MessageFault::Kind kind) {
  switch (kind) {
    case MessageFault::Kind::kDuplicate:
      return table::Kind::kDuplicate;
    case MessageFault::Kind::kCorrupt:
      return table::Kind::kCorrupt;
    case MessageFault::Kind::kDelay:
      return table::Kind::kDelay;
    case MessageFault::Kind::kDrop:
      break;
  }
  return table::Kind::kDrop;
}

table::Side side_of(MessageFault::Side side) {
  switch (side) {
    case MessageFault::Side::kTake:
      return table::Side::kTake;
    case MessageFault::Side::kRequest:
      return table::Side::kRequest;
    case MessageFault::Side::kResponse:
      return table::Side::kResponse;
    case MessageFault::Side::kPublish:
      break;
  }
  return table::Side::kPublish;
}

void copy_name(const std::string& name, char (&to)[table::kNameCapacity]) {
  if (name.size() >= table::kNameCapacity) {
    throw std::system_error(ENAMETOOLONG, std::system_category(), name);
  }
  std::copy(name.begin(), name.end(), to);  // zeros follow
}

void fill(table::Fault& fault, const MessageFault& request) {
  std::construct_at(&fault);
  fault.kind = kind_of(request.kind);
  fault.side = side_of(request.side);
  copy_name(request.topic, fault.topic);
  copy_name(request.node, fault.node);
  fault.first = request.first;
  fault.every = request.every;
  fault.count = request.count.value_or(0);
  fault.delay = request.by.count();
  fault.seed = request.seed;
}

// Nodes of another ROS 2 get a library that applies the faults between their rcl and rmw. Those of this stack apply
// them by themselves, and the library leaves them alone. Messages on loan cannot be changed.
void preload_layer(Environment& environment) {
  const std::string layer = own_library_file("librmw_fault_layer.so");
  if (::access(layer.c_str(), R_OK) != 0) {
    return;
  }
  if (std::string& preloaded = environment["LD_PRELOAD"]; preloaded.find(layer) == std::string::npos) {
    preloaded += (preloaded.empty() ? "" : ":") + layer;  // once, however often the process is started
  }
  environment["ROS_DISABLE_LOANED_MESSAGES"] = "1";
}

[[noreturn]] void fail(const std::string& what) {
  throw std::system_error(errno, std::system_category(), what);
}

}  // namespace

MessageFaults::~MessageFaults() {
  if (table_ != nullptr) {
    ::munmap(table_, table::Table::size_for(subjects_.size()));
  }
  if (!path_.empty()) {
    ::unlink(path_.c_str());
    ::unlink((path_ + table::kWakeSuffix).c_str());
  }
}

void MessageFaults::begin(const std::vector<FaultRequest>& faults, const std::string& directory) {
  std::vector<const MessageFault*> requests;
  for (const FaultRequest& request : faults) {
    if (const auto* const messages = std::get_if<MessageFault>(&request.what);
        messages != nullptr && request.left_out.empty()) {
      requests.push_back(messages);
      subjects_.push_back({request.number, request.process});
    }
  }
  if (requests.empty()) {
    return;
  }
  const std::string path = directory + "/message_faults";
  const std::string wake = path + table::kWakeSuffix;
  if (::mkfifo(wake.c_str(), 0600) != 0) {
    fail(fmt::format("cannot make the pipe '{}'", wake));
  }
  path_ = path;
  wake_.reset(::open(wake.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC));
  const UniqueFd file(::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
  const std::size_t size = table::Table::size_for(requests.size());
  if (!wake_ || !file || ::ftruncate(file.get(), static_cast<off_t>(size)) != 0) {
    fail(fmt::format("cannot make '{}'", path_));
  }
  void* const memory = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file.get(), 0);
  if (memory == MAP_FAILED) {
    fail(fmt::format("cannot map '{}'", path_));
  }
  table_ = static_cast<table::Table*>(memory);
  *table_ = {table::Table::kMagic, sizeof(table::Fault), requests.size()};
  for (std::size_t i = 0; i < requests.size(); ++i) {
    fill(table_->faults()[i], *requests[i]);
  }
  source_ = loop_.on_readable(wake_.get(), [this] {
    std::array<char, 4096> bytes;
    while (::read(wake_.get(), bytes.data(), bytes.size()) > 0) {
    }
    on_hit_();
  });
}

void MessageFaults::prepare(ProcessSpec& spec, ProcessId id) const {
  if (table_ == nullptr) {
    return;
  }
  std::vector<std::string> names = names_of(spec);
  names.push_back(fmt::format("{}-{}", spec.name, id));
  std::string numbers;
  for (std::size_t i = 0; i < subjects_.size(); ++i) {
    if (subjects_[i].process.empty() || std::find(names.begin(), names.end(), subjects_[i].process) != names.end()) {
      numbers += fmt::format("{}{}", numbers.empty() ? "" : ",", i + 1);
    }
  }
  if (!numbers.empty()) {
    spec.environment[table::kVariable] = fmt::format("{}:{}", numbers, path_);
    preload_layer(spec.environment);
  }
}

void MessageFaults::arm(std::size_t number, bool armed) {
  if (table_ != nullptr) {
    fault(number).is_armed = armed ? 1 : 0;
  }
}

MessageFaults::Hits MessageFaults::hits(std::size_t number) const {
  if (table_ == nullptr) {
    return {};
  }
  const table::Fault& found = fault(number);
  return {found.seen, found.hit, Duration(found.first_time.load()), Duration(found.latest_time.load())};
}

table::Fault& MessageFaults::fault(std::size_t number) const {
  const auto found = std::find_if(subjects_.begin(), subjects_.end(),
                                  [&](const Subject& subject) { return subject.number == number; });
  return table_->faults()[found - subjects_.begin()];
}

}  // namespace launch
