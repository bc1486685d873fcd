// SPDX-License-Identifier: Apache-2.0
#include "launcher/traced/machine_trace.hpp"

#include <bit>
#include <cstdint>
#include <optional>
#include <utility>

namespace launch {
namespace {

constexpr std::size_t kText = 4;  // bytes of an empty one

// A program is found, and its libraries, by these variables alone.
constexpr const char* kVariablesOfPrograms[] = {"PATH", "LD_LIBRARY_PATH", "LD_PRELOAD"};

// One function for both directions, so that neither can forget what the other has.
class Putter {
 public:
  explicit Putter(WireWriter& writer) : writer_(writer) {}
  void operator()(const std::string& text) { writer_.text(text); }
  void operator()(bool flag) { writer_.flag(flag); }
  void operator()(std::uint64_t number) { writer_.u64(number); }
  void operator()(std::uint32_t number) { writer_.u32(number); }
  void operator()(std::int64_t number) { writer_.i64(number); }
  void operator()(double number) { writer_.u64(std::bit_cast<std::uint64_t>(number)); }
  template <typename Value>
  void operator()(const std::vector<Value>& values) {
    writer_.u32(static_cast<std::uint32_t>(values.size()));
    for (const Value& value : values) {
      (*this)(value);
    }
  }
  template <typename Value>
  void operator()(const std::optional<Value>& value) {
    writer_.flag(value.has_value());
    if (value) {
      (*this)(*value);
    }
  }
  void operator()(const tracing::ChannelConfig& channel);
  template <typename Choice>
  void choice(const Choice& choice, Choice /*last*/) {
    writer_.u8(static_cast<std::uint8_t>(choice));
  }

 private:
  WireWriter& writer_;
};

class Getter {
 public:
  explicit Getter(WireReader& reader) : reader_(reader) {}
  void operator()(std::string& text) {
    text = reader_.text();
    if (text.find('\0') != std::string::npos) {
      throw WireError("a trace has a zero byte in a name");
    }
  }
  void operator()(bool& flag) { flag = reader_.flag(); }
  void operator()(std::uint64_t& number) { number = reader_.u64(); }
  void operator()(std::uint32_t& number) { number = reader_.u32(); }
  void operator()(std::int64_t& number) { number = reader_.i64(); }
  void operator()(double& number) { number = std::bit_cast<double>(reader_.u64()); }
  template <typename Value>
  void operator()(std::vector<Value>& values) {
    values.clear();
    for (std::uint32_t left = reader_.count(kText); left > 0; --left) {
      (*this)(values.emplace_back());
    }
  }
  template <typename Value>
  void operator()(std::optional<Value>& value) {
    value.reset();
    if (reader_.flag()) {
      (*this)(value.emplace());
    }
  }
  void operator()(tracing::ChannelConfig& channel);
  template <typename Choice>
  void choice(Choice& choice, Choice last) {
    const std::uint8_t number = reader_.u8();
    if (number > static_cast<std::uint8_t>(last)) {
      throw WireError("a trace has a choice that does not exist");
    }
    choice = static_cast<Choice>(number);
  }

 private:
  WireReader& reader_;
};

template <typename Pass, typename Channel>
void pass_channel(Pass& pass, Channel& channel) {
  pass(channel.name);
  pass(channel.events_ust);
  pass(channel.context_fields);
  pass(channel.subbuffer_size);
  pass(channel.subbuffer_count);
  pass(channel.read_timer);
  pass(channel.switch_timer);
  pass(channel.overwrite);
  pass(channel.blocking_timeout);
}

void Putter::operator()(const tracing::ChannelConfig& channel) {
  pass_channel(*this, channel);
}

void Getter::operator()(tracing::ChannelConfig& channel) {
  pass_channel(*this, channel);
}

template <typename Pass, typename Trace>
void pass_trace(Pass& pass, Trace& trace) {
  auto& config = trace.config;
  pass(config.session_name);
  pass(config.events_ust);
  pass(config.events_python);
  pass(config.context_fields_ust);
  pass(config.ust.subbuffer_size);
  pass(config.ust.subbuffer_count);
  pass(config.ust.read_timer);
  pass(config.ust.blocking_timeout);
  pass(config.init_channel);
  pass(config.switch_timer_ust);
  pass(config.overwrite_ust);
  pass.choice(config.buffers_ust, tracing::BufferOwner::kProcess);
  pass(config.tracefile_size);
  pass(config.tracefile_count);
  pass(config.channels);
  pass(config.further_events_ust);
  pass(config.max_overhead);
  pass(config.drop_order);
  pass(config.snapshot_mode);
  pass(config.snapshot_size);
  auto& choices = trace.choices;
  pass(choices.snapshot_on_crash);
  pass(choices.snapshot_on_events);
  pass(choices.callback_deadline);
  pass(choices.message_deadline);
  pass(choices.nodes);
  pass.choice(choices.tracetools, TracetoolsMode::kTheirs);
  pass(choices.python_nodes);
  pass(choices.auto_buffers);
}

template <typename Pass, typename Order>
void pass_order(Pass& pass, Order& order) {
  pass(order.reasons);
  pass(order.died);
  pass(order.moment);
}

}  // namespace

std::string to_wire(const tracing::SnapshotOrder& order) {
  WireWriter writer;
  Putter put(writer);
  pass_order(put, order);
  return writer.bytes();
}

tracing::SnapshotOrder parse_snapshot_order(std::string_view bytes) {
  WireReader reader(bytes);
  Getter get(reader);
  tracing::SnapshotOrder order;
  pass_order(get, order);
  reader.end();
  return order;
}

std::string to_wire(const MachineTrace& trace) {
  WireWriter writer;
  Putter put(writer);
  pass_trace(put, trace);
  writer.u32(static_cast<std::uint32_t>(trace.processes.size()));
  for (const ProcessSpec& spec : trace.processes) {
    put(spec.name);
    put(spec.other_names);
    put(spec.argv);
    put(spec.working_directory);
    put(spec.shell);
    put(spec.traced);
    for (const char* const name : kVariablesOfPrograms) {
      const auto found = spec.environment.find(name);
      put(found == spec.environment.end() ? std::string() : found->second);
    }
  }
  return writer.bytes();
}

MachineTrace parse_machine_trace(std::string_view bytes) {
  WireReader reader(bytes);
  Getter get(reader);
  MachineTrace trace;
  pass_trace(get, trace);
  if (trace.config.session_name.empty() || trace.config.session_name.find('/') != std::string::npos ||
      trace.config.session_name.front() == '.') {
    throw WireError("a trace has a name that is none");
  }
  for (std::uint32_t left = reader.count(kText); left > 0; --left) {
    ProcessSpec& spec = trace.processes.emplace_back();
    get(spec.name);
    get(spec.other_names);
    get(spec.argv);
    get(spec.working_directory);
    get(spec.shell);
    get(spec.traced);
    for (const char* const name : kVariablesOfPrograms) {
      std::string value;
      get(value);
      if (!value.empty()) {
        spec.environment.insert_or_assign(name, std::move(value));
      }
    }
    if (spec.argv.empty()) {
      throw WireError("a process of a trace has no program");
    }
  }
  reader.end();
  trace.config.events_kernel.clear();
  trace.config.has_timestamp = true;  // one that is there already is not in the way
  return trace;
}

}  // namespace launch
