#pragma once
/// Folder resources/ of an FMU: the case, and the references of its variables.

#include <map>
#include <string>

#include "hydrodae/io/case_reader.h"

namespace hydrodae::fmi {

/// Variable of the FMU.
struct Variable {
  enum class Kind {
    time,
    parameter, ///< a value of the case, by its dotted key; fixed when the run begins
    input,     ///< input of run::Simulation, by its name
    output     ///< channel of one value, or one component of it
  };
  /// Type of a value; only parameters may be other than numbers.
  enum class Type { number, integer, boolean, text };

  Kind kind = Kind::time;
  std::string name;
  Type type = Type::number;
  double start = 0.0; ///< start value of parameters and inputs; for a boolean 0 or 1
  std::string text;   ///< start value of a text
};

using Reference = unsigned;

struct Contents {
  std::string token; ///< token of the model description: GUID, or instantiation token
  std::string case_path;
  io::Overrides overrides;
  std::map<Reference, Variable> variables;
};

/// Reads variables.txt. Its lines are fields separated by tabs, beginning with the kind of line:
///
///   hydrodae-fmu  1
///   token         TOKEN
///   set           KEY        VALUE (TOML)
///   time          REFERENCE
///   parameter     REFERENCE  START  KEY        a number
///   integer       REFERENCE  START  KEY        these are parameters, too
///   boolean       REFERENCE  START  KEY        true or false
///   text          REFERENCE  START  KEY
///   input         REFERENCE  START  NAME
///   output        REFERENCE  NAME
///
/// @param resources  folder with case.toml, its files and variables.txt
/// Throws CaseError if the file is missing or a line has another form.
Contents read_contents(const std::string& resources);

/// Folder of a URI "file:///...", with percent-encoding decoded. Throws CaseError for other URIs.
std::string folder_of_uri(const std::string& uri);

} // namespace hydrodae::fmi
