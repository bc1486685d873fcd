// SPDX-License-Identifier: Apache-2.0
// Prints all that the reader tells of traces: print_trace DIRECTORY...
#include <iostream>
#include <launch_trace/reader.hpp>
#include <launch_trace/typed_view.hpp>

namespace {

void print(const launch_trace::Value& value) {
  using Kind = launch_trace::Value::Kind;
  if (value.label()) {
    std::cout << *value.label() << ':';
  }
  switch (value.kind()) {
    case Kind::kUnsigned:
      std::cout << (value.is_hexadecimal() ? std::hex : std::dec) << std::showbase << *value.unsigned_integer()
                << std::dec;
      break;
    case Kind::kSigned:
      std::cout << *value.integer();
      break;
    case Kind::kReal:
      std::cout << *value.real();
      break;
    case Kind::kString:
      std::cout << '"' << *value.string() << '"';
      break;
    case Kind::kArray:
    case Kind::kStructure:
    case Kind::kVariant:
      std::cout << '(';
      for (std::size_t i = 0; i < value.size(); ++i) {
        if (value.kind() == Kind::kStructure) {
          std::cout << value.member_name(i) << '=';
        }
        print(value[i]);
        std::cout << (i + 1 < value.size() ? " " : "");
      }
      std::cout << ')';
      break;
  }
}

void print(const launch_trace::Event& event) {
  std::cout << event.time_ns() << ' ' << event.name() << " host=" << event.trace().hostname
            << " cpu=" << event.cpu_id().value_or(-1) << " vpid=" << event.vpid().value_or(-1)
            << " vtid=" << event.vtid().value_or(-1) << " procname=" << event.procname().value_or("-");
  const launch_trace::EventClass& event_class = event.event_class();
  for (std::size_t i = 0; i < event_class.fields.size(); ++i) {
    std::cout << ' ' << event_class.fields[i] << '=';
    print(event.field(i));
  }
  if (const auto parent = event.context("vppid")) {
    std::cout << " vppid=" << parent->integer().value_or(-1);
  }
  std::cout << '\n';
}

void print_typed(const launch_trace::Event& event) {
  using namespace launch_trace;
  if (const auto init = as<ros2::RclNodeInit>(event)) {
    std::cout << "  node " << init->node_name << '\n';
  }
  if (const auto end = as<ros2_ext::RclNodeFini>(event)) {
    std::cout << "  end of " << end->node_handle << '\n';
  }
  if (const auto exit = as<launch::Exit>(event)) {
    std::cout << "  " << exit->process << " -> " << exit->exit_code << '\n';
  }
  if (const auto cut = as<launch::Cut>(event)) {
    std::cout << "  cut at a share of " << cut->share << '\n';
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    launch_trace::Reader reader(std::vector<std::filesystem::path>(argv + 1, argv + argc));
    for (const launch_trace::Item& item : reader) {
      if (const launch_trace::Event* event = item.event()) {
        print(*event);
        print_typed(*event);
      } else {
        const launch_trace::Loss& loss = *item.loss();
        std::cout << loss.begin_ns.value_or(0) << " lost " << loss.count.value_or(0) << " of "
                  << std::filesystem::path(loss.stream->file).filename().string() << '\n';
      }
    }
    if (reader.lacks_descriptions()) {
      std::cout << "not all events are described yet\n";
    }
    for (const auto& directory : reader.open_directories()) {
      std::cout << "open: " << directory.filename() << '\n';
    }
  } catch (const launch_trace::Error& error) {
    std::cout << "error: " << error.what() << "\nhelp: " << error.remedy() << '\n';
    return 1;
  }
}
