// SPDX-License-Identifier: Apache-2.0
// What an editor sends: frames, changes of a document, and what the language server reads in a file that is being
// written.
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "programs/launch/lsp/argument_places.hpp"
#include "programs/launch/lsp/document.hpp"
#include "programs/launch/lsp/features.hpp"
#include "programs/launch/lsp/message_stream.hpp"
#include "programs/launch/lsp/python_source.hpp"
#include "programs/launch/lsp/python_values.hpp"
#include "tests/fuzz/fuzz_input.hpp"

namespace {

using launch::lsp::Document;
using launch::lsp::Json;

void require(bool holds) {
  if (!holds) {
    std::abort();
  }
}

void read_document(const Document& document) {
  const std::string& text = document.text();
  const launch::lsp::Outline outline = launch::lsp::outline_of(text);
  for (const launch::lsp::OutlineElement& element : outline.elements) {
    require(element.tag_span.end <= text.size() && element.parent < static_cast<int>(outline.elements.size()));
    for (const launch::lsp::OutlineAttribute& attribute : element.attributes) {
      require(attribute.name_span.end <= text.size() && (!attribute.value || attribute.value->end <= text.size()));
    }
  }
  for (const launch::lsp::ArgumentPlace& place : argument_places(outline, text)) {
    require(place.span.begin <= place.span.end && place.span.end <= text.size());
  }
  const launch::lsp::Reading reading = {"/f", document, outline};
  require(semantic_tokens(reading).at("data").size() % 5 == 0);
  for (std::size_t at = 0; at <= text.size(); at += 7) {
    require(document.offset(document.position(at)) <= text.size());
    require(document.offset_of_character(at, at) <= text.size());
  }
}

// A Python launch file, whose calls and values are read as far as they are written.
void read_python(const std::string& text) {
  const launch::lsp::PythonSource source = launch::lsp::python_source_of(text);
  for (std::size_t number = 0; number < source.brackets.size(); ++number) {
    const launch::lsp::PythonBrackets& brackets = source.brackets[number];
    require(source.brackets_from(brackets.first - 1) == static_cast<int>(number));
    require(brackets.inside.begin <= brackets.inside.end && brackets.inside.end <= text.size());
    require(brackets.first <= brackets.last && brackets.last <= source.tokens.size());
    for (const launch::lsp::PythonArgument& argument : brackets.arguments) {
      require(argument.first <= argument.last && argument.last <= source.tokens.size());
    }
  }
  const std::string path = "/f.launch.py";
  const launch::lsp::PythonFileText file{[](const std::string& package) { return "/share/" + package; }, path, text,
                                         source};
  for (const launch::lsp::ArgumentPlace& place : python_argument_places(file)) {
    require(place.span.begin <= place.span.end && place.span.end <= text.size());
  }
  static_cast<void>(python_arguments(file));
  for (const launch::lsp::PythonBrackets& brackets : source.brackets) {
    for (const launch::lsp::PythonArgument& argument : brackets.arguments) {
      static_cast<void>(file.value(&argument));
    }
  }
}

// The messages of a stream that comes in pieces are those of the whole one.
void read_messages(const std::string& bytes) {
  launch::lsp::MessageReader reader;
  Document document("<launch/>");
  try {
    for (std::size_t at = 0; at < bytes.size(); at += 13) {
      reader.add(std::string_view(bytes).substr(at, 13));
      while (const std::optional<Json> message = reader.next()) {
        if (message->is_object()) {
          document.change(*message);
        }
      }
    }
  } catch (const Json::exception&) {
    // no change
  } catch (const std::runtime_error&) {
    // no frame
  }
  read_document(document);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  read_messages(bytes);
  Document document(bytes);
  read_document(document);
  read_python(bytes);
  // The bytes in the middle of the document, at every place that the first bytes choose.
  if (size > 2) {
    const Json begin = document.position(data[0]);
    const Json end = document.position(data[0] + std::size_t{data[1]});
    document.change({{"range", {{"start", begin}, {"end", end}}}, {"text", "<node pkg=\"$(var x)\"\n"}});
    read_document(document);
  }
  return 0;
}
