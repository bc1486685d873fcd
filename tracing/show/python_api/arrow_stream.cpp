// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/python_api/arrow_stream.hpp"

#include <cerrno>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

// As https://arrow.apache.org/docs/format/CDataInterface.html says.
extern "C" {
struct ArrowSchema {
  const char* format;
  const char* name;
  const char* metadata;
  std::int64_t flags;
  std::int64_t n_children;
  ArrowSchema** children;
  ArrowSchema* dictionary;
  void (*release)(ArrowSchema*);
  void* private_data;
};
struct ArrowArray {
  std::int64_t length;
  std::int64_t null_count;
  std::int64_t offset;
  std::int64_t n_buffers;
  std::int64_t n_children;
  const void** buffers;
  ArrowArray** children;
  ArrowArray* dictionary;
  void (*release)(ArrowArray*);
  void* private_data;
};
struct ArrowArrayStream {
  int (*get_schema)(ArrowArrayStream*, ArrowSchema*);
  int (*get_next)(ArrowArrayStream*, ArrowArray*);
  const char* (*get_last_error)(ArrowArrayStream*);
  void (*release)(ArrowArrayStream*);
  void* private_data;
};
}

namespace tracing::python {

namespace {

constexpr std::int64_t kNullable = 2;

// What a schema or an array of this file owns. Its children and dictionary are parts of it.
template <class Struct>
struct Owned {
  std::shared_ptr<const TableColumns> table;
  std::vector<std::unique_ptr<Struct>> parts;
  std::vector<Struct*> children;
  std::vector<const void*> buffers;
  std::vector<std::uint8_t> bits;
  std::vector<std::int32_t> offsets;
  std::string text;
};

template <class Struct>
void release(Struct* released) {
  auto* const owned = static_cast<Owned<Struct>*>(released->private_data);
  for (const std::unique_ptr<Struct>& part : owned->parts) {
    if (part->release != nullptr) {
      part->release(part.get());
    }
  }
  delete owned;
  released->release = nullptr;
}

template <class Struct>
Owned<Struct>& own(Struct* made, std::shared_ptr<const TableColumns> table) {
  *made = {};
  auto* const owned = new Owned<Struct>;
  owned->table = std::move(table);
  made->private_data = owned;
  made->release = release<Struct>;
  return *owned;
}

const char* format_of(ColumnType type) {
  switch (type) {
    case ColumnType::kReal:
      return "g";
    case ColumnType::kText:
      return "i";  // of the codes
    case ColumnType::kInteger:
      break;
  }
  return "l";
}

void make_schema(const std::shared_ptr<const TableColumns>& table, ArrowSchema* schema) {
  Owned<ArrowSchema>& all = own(schema, table);
  schema->format = "+s";
  schema->name = "";
  for (const ColumnValues& values : table->columns) {
    ArrowSchema* const child = all.parts.emplace_back(std::make_unique<ArrowSchema>()).get();
    Owned<ArrowSchema>& owned = own(child, table);
    child->format = format_of(values.column.type);
    child->name = values.column.name.c_str();
    child->flags = kNullable;
    if (values.column.type == ColumnType::kText) {
      child->dictionary = owned.parts.emplace_back(std::make_unique<ArrowSchema>()).get();
      own(child->dictionary, table);
      child->dictionary->format = "u";
      child->dictionary->name = "";
    }
    all.children.push_back(child);
  }
  schema->n_children = static_cast<std::int64_t>(all.children.size());
  schema->children = all.children.data();
}

void set_validity(const ColumnValues& values, std::size_t rows, ArrowArray* array, Owned<ArrowArray>& owned) {
  owned.buffers.push_back(nullptr);
  if (values.is_null.empty()) {
    return;
  }
  owned.bits.resize((rows + 7) / 8);
  for (std::size_t row = 0; row < rows; ++row) {
    if (values.is_null[row] != 0) {
      ++array->null_count;
    } else {
      owned.bits[row / 8] |= static_cast<std::uint8_t>(1U << (row % 8));
    }
  }
  owned.buffers[0] = owned.bits.data();
}

void set_buffers(ArrowArray* array, Owned<ArrowArray>& owned) {
  array->n_buffers = static_cast<std::int64_t>(owned.buffers.size());
  array->buffers = owned.buffers.data();
}

ArrowArray* add_words(const std::shared_ptr<const TableColumns>& table, const ColumnValues& values,
                      Owned<ArrowArray>& column) {
  ArrowArray* const words = column.parts.emplace_back(std::make_unique<ArrowArray>()).get();
  Owned<ArrowArray>& owned = own(words, table);
  words->length = static_cast<std::int64_t>(values.words.size());
  owned.offsets.push_back(0);
  for (const std::string& word : values.words) {
    owned.text += word;
    owned.offsets.push_back(static_cast<std::int32_t>(owned.text.size()));
  }
  owned.buffers = {nullptr, owned.offsets.data(), owned.text.data()};
  set_buffers(words, owned);
  return words;
}

void make_array(const std::shared_ptr<const TableColumns>& table, ArrowArray* array) {
  Owned<ArrowArray>& all = own(array, table);
  array->length = static_cast<std::int64_t>(table->rows);
  all.buffers.push_back(nullptr);
  set_buffers(array, all);
  for (const ColumnValues& values : table->columns) {
    ArrowArray* const child = all.parts.emplace_back(std::make_unique<ArrowArray>()).get();
    Owned<ArrowArray>& owned = own(child, table);
    child->length = array->length;
    set_validity(values, table->rows, child, owned);
    if (values.column.type == ColumnType::kInteger) {
      owned.buffers.push_back(values.integers.data());
    } else if (values.column.type == ColumnType::kReal) {
      owned.buffers.push_back(values.reals.data());
    } else {
      owned.buffers.push_back(values.codes.data());
      child->dictionary = add_words(table, values, owned);
    }
    set_buffers(child, owned);
    all.children.push_back(child);
  }
  array->n_children = static_cast<std::int64_t>(all.children.size());
  array->children = all.children.data();
}

struct Stream {
  std::shared_ptr<const TableColumns> table;
  bool is_told = false;
};

int get_schema(ArrowArrayStream* stream, ArrowSchema* schema) {
  make_schema(static_cast<Stream*>(stream->private_data)->table, schema);
  return 0;
}

int get_next(ArrowArrayStream* stream, ArrowArray* array) {
  auto* const state = static_cast<Stream*>(stream->private_data);
  if (std::exchange(state->is_told, true)) {
    *array = {};  // released: the end
  } else {
    make_array(state->table, array);
  }
  return 0;
}

void release_stream(ArrowArrayStream* stream) {
  delete static_cast<Stream*>(stream->private_data);
  stream->release = nullptr;
}

void destroy_capsule(PyObject* capsule) {
  auto* const stream = static_cast<ArrowArrayStream*>(PyCapsule_GetPointer(capsule, "arrow_array_stream"));
  if (stream->release != nullptr) {
    stream->release(stream);  // nobody has taken it
  }
  delete stream;
}

}  // namespace

pybind11::capsule arrow_stream(std::shared_ptr<const TableColumns> table) {
  auto stream = std::make_unique<ArrowArrayStream>();
  *stream = {get_schema, get_next, [](ArrowArrayStream*) -> const char* { return nullptr; }, release_stream,
             new Stream{std::move(table)}};
  PyObject* const capsule = PyCapsule_New(stream.get(), "arrow_array_stream", destroy_capsule);
  if (capsule == nullptr) {
    stream->release(stream.get());
    throw pybind11::error_already_set();
  }
  static_cast<void>(stream.release());  // it belongs to the capsule
  return pybind11::reinterpret_steal<pybind11::capsule>(capsule);
}

}  // namespace tracing::python
