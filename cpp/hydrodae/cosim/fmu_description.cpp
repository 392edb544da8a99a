#include "hydrodae/cosim/fmu_description.h"

#include <algorithm>
#include <set>

#include <pugixml.hpp>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/cosim/fmu_archive.h"

namespace hydrodae::cosim {

namespace {

#if defined(__aarch64__)
constexpr const char* platforms[] = {"linux-aarch64", "aarch64-linux"};
#else
constexpr const char* platforms[] = {"linux64", "x86_64-linux"}; ///< of FMI 2 and 3
#endif

[[noreturn]] void refuse_fmu(const std::string& path, const std::string& why) {
  throw CaseError(path + ": " + why);
}

FmuVariable variable_of(int version, const pugi::xml_node& node) {
  FmuVariable out;
  out.name = node.attribute("name").value();
  out.reference = node.attribute("valueReference").as_uint();
  out.causality = node.attribute("causality").as_string("local");
  if (version == 3)
    out.type = node.name();
  else
    for (const pugi::xml_node child : node.children())
      if (std::string(child.name()) != "Annotations")
        out.type = child.name();
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
  return names.empty() ? "there is none at all" : "there are " + joined(names);
}

} // namespace

std::string FmuDescription::binaries() const {
  return std::string("binaries/") + platforms[version - 2] + "/";
}

const FmuVariable& FmuDescription::find(const std::string& name,
                                        const std::string& causality) const {
  std::vector<std::string> names;
  for (const FmuVariable& v : variables) {
    if (v.causality == causality)
      names.push_back(v.name);
    if (v.name != name)
      continue;
    if (v.causality != causality)
      throw CaseError("variable " + in_quotes(name) + " of the FMU is of causality " +
                      in_quotes(v.causality) + ", expected " + in_quotes(causality));
    const std::string wanted = version == 2 ? "Real" : "Float64";
    if (v.type != wanted || v.is_array)
      throw CaseError("variable " + in_quotes(name) + " of the FMU is of type " + v.type +
                      (v.is_array ? " (an array)" : "") + ", expected one number of type " +
                      wanted);
    return v;
  }
  throw CaseError("the FMU has no " + causality + " " + in_quotes(name) + suggestion(name, names));
}

FmuDescription describe_fmu(const std::string& path) {
  const std::string text = read_model_description(path);
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
  for (const pugi::xml_node node : root.child("ModelVariables").children())
    out.variables.push_back(variable_of(out.version, node));
  const std::vector<std::string> files = list_files(path);
  if (std::find(files.begin(), files.end(), out.library()) == files.end())
    refuse_fmu(path,
               "has no library " + out.library() + " for this machine; " + platforms_of(files));
  return out;
}

} // namespace hydrodae::cosim
