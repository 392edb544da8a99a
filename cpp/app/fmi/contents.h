#pragma once
/// What lies in the folder resources/ of an FMU: the case, and which variable has which reference.

#include <map>
#include <string>

#include "hydrodae/io/case_reader.h"

namespace hydrodae::fmi {

/// A variable of the FMU.
struct Variable {
  enum class Kind {
    time,
    parameter, ///< a value of the case, by its dotted key; fixed when the run begins
    input,     ///< of run::Simulation, by its name
    output     ///< a channel of one number, or one component of it
  };
  /// All but parameters are numbers.
  enum class Type { number, integer, boolean, text };

  Kind kind = Kind::time;
  std::string name;
  Type type = Type::number;
  double start = 0.0; ///< of parameters and inputs; of a boolean 0 or 1
  std::string text;   ///< the start of a text
};

using Reference = unsigned;

struct Contents {
  std::string token; ///< of the model description: GUID, or instantiation token
  std::string case_path;
  io::Overrides overrides;
  std::map<Reference, Variable> variables;
};

/// Reads variables.txt, whose lines are fields with tabs in between, the kind of line first:
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
/// @param resources  the folder; case.toml and the files that it names lie beside variables.txt
/// Throws CaseError without such a file, or at a line of another form.
Contents read_contents(const std::string& resources);

/// The folder of a URI "file:///...", with %20 and the like decoded. Throws CaseError for others.
std::string folder_of_uri(const std::string& uri);

} // namespace hydrodae::fmi
