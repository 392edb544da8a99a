#include "contents.h"

#include <charconv>
#include <fstream>
#include <string_view>
#include <vector>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"

namespace hydrodae::fmi {

namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> out;
  for (std::size_t from = 0;;) {
    const std::size_t tab = line.find('\t', from);
    out.push_back(line.substr(from, tab - from));
    if (tab == std::string::npos)
      return out;
    from = tab + 1;
  }
}

template <class Number> Number number_of(const std::string& text) {
  Number out{};
  const char* end = text.data() + text.size();
  if (const auto [at, error] = std::from_chars(text.data(), end, out);
      error != std::errc() || at != end)
    throw CaseError(in_quotes(text) + " is no number");
  return out;
}

void take_line(const std::vector<std::string>& field, Contents& out) {
  using Kind = Variable::Kind;
  using Type = Variable::Type;
  const auto is = [&](std::string_view kind, std::size_t count) {
    return field[0] == kind && field.size() == count;
  };
  const auto add = [&](Variable variable) {
    if (!out.variables.emplace(number_of<Reference>(field[1]), std::move(variable)).second)
      throw CaseError("there are two variables " + field[1]);
  };
  if (is("token", 2))
    out.token = field[1];
  else if (is("set", 3))
    out.overrides[field[1]] = field[2];
  else if (is("time", 2))
    add({Kind::time, "time", Type::number, 0.0, ""});
  else if (is("parameter", 4))
    add({Kind::parameter, field[3], Type::number, number_of<double>(field[2]), ""});
  else if (is("integer", 4))
    add({Kind::parameter, field[3], Type::integer, double(number_of<int>(field[2])), ""});
  else if (is("boolean", 4))
    add({Kind::parameter, field[3], Type::boolean, field[2] == "true" ? 1.0 : 0.0, ""});
  else if (is("text", 4))
    add({Kind::parameter, field[3], Type::text, 0.0, field[2]});
  else if (is("input", 4))
    add({Kind::input, field[3], Type::number, number_of<double>(field[2]), ""});
  else if (is("output", 3))
    add({Kind::output, field[2], Type::number, 0.0, ""});
  else
    throw CaseError("a line of kind " + in_quotes(field[0]) + " with " +
                    std::to_string(field.size()) + " fields means nothing");
}

} // namespace

Contents read_contents(const std::string& resources) {
  const std::string folder = resources.ends_with('/') ? resources : resources + "/";
  const std::string path = folder + "variables.txt";
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line) || line != "hydrodae-fmu\t1")
    throw CaseError(path + ": not there, or not of an FMU of hydrodae " HYDRODAE_VERSION);
  Contents out;
  out.case_path = folder + "case.toml";
  for (int number = 2; std::getline(file, line); ++number)
    try {
      take_line(split(line), out);
    } catch (const CaseError& error) {
      throw CaseError({path, number}, "", error.what());
    }
  return out;
}

std::string folder_of_uri(const std::string& uri) {
  // RFC 8089: file:///folder, file:/folder or file://localhost/folder
  std::string_view rest = uri;
  const auto skip = [&](std::string_view head) {
    const bool there = rest.starts_with(head);
    rest.remove_prefix(there ? head.size() : 0);
    return there;
  };
  if (!skip("file:"))
    throw CaseError("the resources of the FMU are at " + in_quotes(uri) +
                    ": expected a URI file:///folder");
  if (skip("//"))
    skip("localhost");
  std::string out;
  for (std::size_t k = 0; k < rest.size(); ++k) {
    unsigned code = 0;
    const char* digits = rest.data() + k + 1;
    if (rest[k] == '%' && k + 2 < rest.size() &&
        std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2) {
      out += static_cast<char>(code);
      k += 2;
    } else {
      out += rest[k];
    }
  }
  return out;
}

} // namespace hydrodae::fmi
