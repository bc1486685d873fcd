// SPDX-License-Identifier: Apache-2.0
// One reading of a trace, the iterator of Python that goes through it, and launch_trace.Loss: events that the tracer
// could not keep.
#pragma once

#include <pybind11/pybind11.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tracing/decode/python_api/event_object.hpp"
#include "tracing/decode/reader/event.hpp"
#include "tracing/decode/reader/trace_reader.hpp"

namespace tracing::python {

// Adds the type launch_trace.Loss to the module.
void add_loss_type(pybind11::module_& module);

// What a reading found, beside the events.
struct Findings {
  std::vector<std::string> damage;
  std::vector<std::filesystem::path> open_directories;
  bool lacks_descriptions = false;
};

struct ReadingOptions {
  std::vector<std::filesystem::path> directories;
  bool damage_is_error = true;  // at the end
  pybind11::object event_type;
};

class Reading {
 public:
  // With patterns: only the events whose names match one of them, and no losses.
  Reading(const ReadingOptions& options, std::shared_ptr<Findings> findings, std::vector<std::string> patterns);

  // The next event or loss; null at the end. Throws TraceReadError.
  pybind11::object next();
  // All that is left, as read_columns() does it.
  pybind11::dict columns(const std::string& event, const std::optional<std::vector<std::string>>& names);

 private:
  void end();
  bool is_wanted(const EventClass& event_class);

  TraceReader reader_;
  bool damage_is_error_;
  std::shared_ptr<Findings> findings_;
  EventMaker maker_;
  std::vector<std::string> patterns_;
  ByEventClass<bool> is_wanted_;
  std::size_t items_ = 0;
};

// Makes the type of the iterators. `error` is the exception for a TraceReadError.
pybind11::object make_iterator_type(pybind11::object error);
pybind11::object make_iterator(const pybind11::object& type, std::unique_ptr<Reading> reading);

// Sets Python's exception.
void set_error(const TraceReadError& failure, pybind11::handle error);

}  // namespace tracing::python
