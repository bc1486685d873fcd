// SPDX-License-Identifier: Apache-2.0
// The calls, imports and names of a Python launch file as they stand in the text, also of one that is being written and
// has errors. Nothing of the file is run. Python's own parser refuses what is not well-formed, so this reads what is
// there, and takes what is missing as it is.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "programs/launch/outline/outline.hpp"

namespace launch::lsp {

struct PythonToken {
  enum class Kind { kName, kNumber, kString, kOperator, kLineEnd };

  Kind kind;
  Span span;
  Span content = {};              // of a string, without prefix and quotes
  bool is_format = false;         // an f-string
  bool starts_statement = false;  // the first one of a line
};

struct PythonArgument {
  std::string keyword;  // "" if it is positional
  Span keyword_span;
  std::size_t first = 0;  // tokens of the value: [first, last)
  std::size_t last = 0;
  Span whole;  // to the comma or to the bracket, with blanks
};

// A pair of brackets with what stands in it. A call has a callee.
struct PythonBrackets {
  char open = '(';
  std::string callee;  // "launch.actions.Node" as it is written; "" for a tuple, a list, a dictionary
  Span callee_span;
  Span inside;            // the text end for one that is not closed
  int parent = -1;        // the number of the brackets around it in PythonSource::brackets
  std::size_t first = 0;  // tokens inside: [first, last)
  std::size_t last = 0;
  bool closed = false;
  std::vector<PythonArgument> arguments;  // also the items of a list, and the pairs of a dictionary

  const PythonArgument* find(std::string_view keyword) const;
  // By its keyword, or by its place.
  const PythonArgument* find(std::string_view keyword, std::size_t place) const;
};

struct PythonImport {
  std::string module;  // as in `from MODULE import`, or `import MODULE`
  Span module_span;
  std::string name;  // "" for `import MODULE`, "*" for all
  Span name_span;
  std::string as;  // by which the file calls it
};

struct PythonSource {
  std::vector<PythonToken> tokens;
  std::vector<PythonBrackets> brackets;  // in the order in which they open
  std::vector<int> opened;               // for each token the number of the brackets that it opens; -1 for none
  std::vector<PythonImport> imports;
  std::map<std::string, std::pair<std::size_t, std::size_t>> values;  // NAME = …: its tokens, of the last assignment
  std::map<std::string, Span> definitions;                            // names that are assigned, or of functions

  // The number of the innermost brackets that hold the place; -1 for none.
  int brackets_at(std::size_t offset) const;
  // The number of the brackets that begin with this token; -1 for none.
  int brackets_from(std::size_t token) const;
  // The token that holds the place, or nullptr.
  const PythonToken* token_at(std::size_t offset) const;
  // "launch_ros.actions.Node" of what the file calls "Node", "actions.Node" or "ros.Node"; "" for a name of its own.
  std::string full_name(std::string_view written) const;
};

PythonSource python_source_of(std::string_view text);

}  // namespace launch::lsp
