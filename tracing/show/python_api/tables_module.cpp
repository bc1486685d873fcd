// SPDX-License-Identifier: Apache-2.0
// The module `launch_trace._tables` of Python: an analysed trace, and its tables as columns.
#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tracing/decode/reader/trace_read_error.hpp"
#include "tracing/model/chains/chain_definition.hpp"
#include "tracing/show/python_api/arrow_stream.hpp"
#include "tracing/show/report/read_system.hpp"
#include "tracing/show/tables/table_columns.hpp"

namespace tracing::python {
namespace {

namespace py = pybind11;

// The numbers of a column, which NumPy and memoryview see without a copy. They live as long as this object.
struct Buffer {
  std::shared_ptr<const TableColumns> table;
  py::buffer_info (*info)(const ColumnValues&) = nullptr;
  std::size_t column = 0;
};

template <auto kMember>
py::buffer_info info_of(const ColumnValues& values) {
  auto& list = const_cast<ColumnValues&>(values).*kMember;
  return {list.data(), static_cast<py::ssize_t>(list.size()), true};
}

class Columns {
 public:
  explicit Columns(TableColumns columns) : table_(std::make_shared<const TableColumns>(std::move(columns))) {}

  std::size_t rows() const { return table_->rows; }

  // Of each column: its name, its values, the words that these are codes of or None, and which of them are none or
  // None.
  py::list parts() const {
    py::list parts;
    for (std::size_t i = 0; i < table_->columns.size(); ++i) {
      const ColumnValues& values = table_->columns[i];
      py::object words = py::none();
      Buffer buffer{table_, info_of<&ColumnValues::integers>, i};
      if (values.column.type == ColumnType::kReal) {
        buffer.info = info_of<&ColumnValues::reals>;
      } else if (values.column.type == ColumnType::kText) {
        buffer.info = info_of<&ColumnValues::codes>;
        py::list texts;
        for (const std::string& word : values.words) {
          texts.append(py::reinterpret_steal<py::object>(
              PyUnicode_DecodeUTF8(word.data(), static_cast<py::ssize_t>(word.size()), "replace")));
        }
        words = std::move(texts);
      }
      py::object nulls = py::none();
      if (!values.is_null.empty()) {
        nulls = py::cast(Buffer{table_, info_of<&ColumnValues::is_null>, i});
      }
      parts.append(py::make_tuple(values.column.name, py::cast(std::move(buffer)), words, nulls));
    }
    return parts;
  }

  py::capsule stream() const { return arrow_stream(table_); }

 private:
  std::shared_ptr<const TableColumns> table_;
};

class System {
 public:
  System(const std::vector<std::filesystem::path>& directories, bool all) {
    SystemOptions options;
    options.all = all;
    options.with_details = true;
    for (const std::filesystem::path& directory : directories) {
      try {
        for (ChainDefinition& chain : read_chains(directory)) {
          if (std::find(options.chains.begin(), options.chains.end(), chain) == options.chains.end()) {
            options.chains.push_back(std::move(chain));
          }
        }
      } catch (const std::runtime_error& failure) {
        warnings_.emplace_back(failure.what());
      }
    }
    const py::gil_scoped_release others_run;
    system_ = read_system(directories, options);
    tables_ = tables_of(system_);
  }
  System(const System&) = delete;
  System& operator=(const System&) = delete;

  Columns columns(const std::string& name) const { return Columns(columns_of(table(name))); }
  std::string help(const std::string& name) const { return table(name).help; }
  const std::string& error() const { return system_.error; }
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  const Table& table(const std::string& name) const {
    for (const Table& table : tables_) {
      if (table.name == name) {
        return table;
      }
    }
    throw py::key_error(name);
  }

  TracedSystem system_;
  std::vector<Table> tables_;
  std::vector<std::string> warnings_;
};

std::vector<std::string> names_of_tables() {
  std::vector<std::string> names;
  const TracedSystem none;
  for (const Table& table : tables_of(none)) {
    names.push_back(table.name);
  }
  return names;
}

}  // namespace

PYBIND11_MODULE(_tables, module) {
  module.doc() = "The tables of an analysed trace. Use launch_trace.open().";
  module.attr("VERSION") = kTablesVersion;
  module.attr("NAMES") = names_of_tables();
  // TraceError is that of the events.
  const py::object error = py::module_::import("launch_trace").attr("TraceError");
  static PyObject* const trace_error = error.inc_ref().ptr();
  py::register_local_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) {
        std::rethrow_exception(thrown);
      }
    } catch (const TraceReadError& failure) {
      const std::string help = failure.remedy().empty() ? "" : "\n      = help: " + failure.remedy();
      PyErr_SetString(trace_error, (failure.what() + help).c_str());
    }
  });
  py::class_<Buffer>(module, "Buffer", py::buffer_protocol()).def_buffer([](Buffer& buffer) {
    return buffer.info(buffer.table->columns[buffer.column]);
  });
  py::class_<Columns>(module, "Columns")
      .def_property_readonly("rows", &Columns::rows)
      .def("parts", &Columns::parts)
      .def("stream", &Columns::stream);
  py::class_<System>(module, "System")
      .def(py::init<const std::vector<std::filesystem::path>&, bool>())
      .def("columns", &System::columns)
      .def("help", &System::help)
      .def_property_readonly("error", &System::error)
      .def_property_readonly("warnings", &System::warnings);
}

}  // namespace tracing::python
