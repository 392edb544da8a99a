#include "hydrodae/cosim/fmu_description.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>

#include <pugixml.hpp>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/cosim/fmu_archive.h"
#include "hydrodae/cosim/foreign_text.h"

namespace hydrodae::cosim {

namespace {

#if defined(__aarch64__)
constexpr const char* platforms[] = {"linux-aarch64", "aarch64-linux"};
#else
/// Platform folders of FMI 2 and 3
constexpr const char* platforms[] = {"linux64", "x86_64-linux"};
#endif

[[noreturn]] void refuse_fmu(const std::string& path, const std::string& why) {
  throw CaseError(path + ": " + why);
}

/// Units of an FMU: their definitions, and those of its types by their names.
struct Units {
  std::map<std::string, Unit> meanings;
  std::map<std::string, std::string> of_types;

  Units(const pugi::xml_node& root, bool two) {
    for (const pugi::xml_node node : root.child("UnitDefinitions").children("Unit"))
      if (const pugi::xml_node base = node.child("BaseUnit")) {
        Unit unit;
        for (std::size_t k = 0; k < unit.powers.size(); ++k)
          unit.powers[k] = base.attribute(Unit::bases[k]).as_int();
        unit.factor = base.attribute("factor").as_double(1.0);
        unit.offset = base.attribute("offset").as_double(0.0);
        meanings[node.attribute("name").value()] = unit;
      }
    for (const pugi::xml_node node : root.child("TypeDefinitions").children()) {
      const pugi::xml_node type = two ? node.child("Real") : node;
      of_types[node.attribute("name").value()] = type.attribute("unit").value();
    }
  }

  void tell(const pugi::xml_node& type, FmuVariable& v) const {
    v.unit_name = type.attribute("unit").value();
    const auto own = of_types.find(type.attribute("declaredType").value());
    if (v.unit_name.empty() && own != of_types.end())
      v.unit_name = own->second;
    if (const auto meaning = meanings.find(v.unit_name); meaning != meanings.end())
      v.unit = meaning->second;
  }
};

std::optional<unsigned> reference_of(const pugi::xml_node& node) {
  const std::string text = node.attribute("valueReference").value();
  unsigned out = 0;
  const char* end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data(), end, out);
  return error == std::errc() && at == end ? std::optional(out) : std::nullopt;
}

FmuVariable variable_of(int version, const pugi::xml_node& node, const Units& units) {
  FmuVariable out;
  out.name = node.attribute("name").value();
  out.reference = reference_of(node);
  out.causality = node.attribute("causality").as_string("local");
  if (version == 3) {
    out.type = node.name();
    units.tell(node, out);
  } else {
    for (const pugi::xml_node child : node.children())
      if (std::string(child.name()) != "Annotations") {
        out.type = child.name();
        units.tell(child, out);
      }
  }
  out.kind = fmu_type(version, out.type);
  out.is_array = version == 3 && node.child("Dimension");
  return out;
}

/// Folders of `binaries` in words.
std::string platforms_of(const std::vector<std::string>& files) {
  const std::string head = "binaries/";
  std::set<std::string> names;
  for (const std::string& file : files)
    if (const auto slash = file.find('/', head.size());
        file.starts_with(head) && slash != std::string::npos)
      names.insert(file.substr(head.size(), slash - head.size()));
  return names.empty() ? "the list is empty" : "there are " + joined(names);
}

} // namespace

std::string FmuDescription::binaries() const {
  return std::string("binaries/") + platforms[version - 2] + "/";
}

Conversion FmuVariable::to(const std::string& wanted, const std::string& of) const {
  const std::optional<Unit> own = unit ? unit : unit_of(unit_name), other = unit_of(wanted);
  const auto refuse = [&](const std::string& meaning) {
    throw CaseError("variable " + in_quotes(name) + " of the FMU is in " + in_quotes(unit_name) +
                    " (" + meaning + "), which is no unit of " + in_quotes(of) + ", in " +
                    in_quotes(wanted));
  };
  if (!own || !other)
    return {};
  if (!std::isfinite(own->factor) || own->factor == 0.0 || !std::isfinite(own->offset))
    refuse("of factor " + number_text(own->factor) + " and offset " + number_text(own->offset));
  if (unit_name == "Hz" && wanted.starts_with("rad")) // the same powers, but 2 pi beside each other
    refuse("turns in a second; rad/s is meant by another name");
  const std::optional<Conversion> out = conversion(*own, *other);
  if (!out)
    refuse(own->text());
  return *out;
}

const FmuVariable& FmuDescription::find(const std::string& name, const std::string& causality,
                                        bool text) const {
  std::vector<std::string> names;
  for (const FmuVariable& v : variables) {
    if (v.causality == causality)
      names.push_back(v.name);
    if (v.name != name)
      continue;
    if (v.causality != causality)
      throw CaseError("variable " + in_quotes(name) + " of the FMU is of causality " +
                      in_quotes(v.causality) + ", expected " + in_quotes(causality));
    const bool fits = v.kind != FmuType::other && (v.kind == FmuType::text) == text;
    if (!fits || v.is_array)
      throw CaseError("variable " + in_quotes(name) + " of the FMU is of type " +
                      (v.type.empty() ? "unknown" : v.type) + (v.is_array ? " (an array)" : "") +
                      ", expected one " + (text ? "string" : "number, boolean or enumeration"));
    if (!v.reference)
      throw CaseError("variable " + in_quotes(name) +
                      " of the FMU has no valueReference that is a number");
    return v;
  }
  throw CaseError("the FMU has no " + causality + " " + in_quotes(name) + suggestion(name, names));
}

FmuDescription describe_fmu(const std::string& path) {
  const std::string text = valid_utf8(read_model_description(path));
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(text.data(), text.size());
  if (!parsed)
    refuse_fmu(path, std::string("modelDescription.xml: ") + parsed.description() + " at byte " +
                         std::to_string(parsed.offset));
  const pugi::xml_node root = document.child("fmiModelDescription");
  const std::string version = root.attribute("fmiVersion").value();
  FmuDescription out;
  out.path = path;
  out.version = version.starts_with("2.") ? 2 : version.starts_with("3.") ? 3 : 0;
  if (out.version == 0)
    refuse_fmu(path, "is of version " + in_quotes(version) +
                         " of FMI; those of 2.0 and 3.0 can be loaded");
  const pugi::xml_node how = root.child("CoSimulation");
  if (!how)
    refuse_fmu(path, root.child("ModelExchange")
                         ? "is for model exchange only; a controller needs one for co-simulation"
                         : "is not for co-simulation");
  const bool two = out.version == 2;
  out.identifier = how.attribute("modelIdentifier").value();
  out.token = root.attribute(two ? "guid" : "instantiationToken").value();
  out.saves_states =
      how.attribute(two ? "canGetAndSetFMUstate" : "canGetAndSetFMUState").as_bool() &&
      how.attribute(two ? "canSerializeFMUstate" : "canSerializeFMUState").as_bool();
  const Units units(root, two);
  for (const pugi::xml_node node : root.child("ModelVariables").children())
    out.variables.push_back(variable_of(out.version, node, units));
  const std::vector<std::string> files = list_files(path);
  if (std::find(files.begin(), files.end(), out.library()) == files.end())
    refuse_fmu(path,
               "has no library " + out.library() + " for this machine; " + platforms_of(files));
  return out;
}

} // namespace hydrodae::cosim
