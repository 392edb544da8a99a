#include "hydrodae/io/mesh_file.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>
#include <vector>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"

namespace hydrodae::io {

namespace {

static_assert(std::endian::native == std::endian::little, "binary .stl files are little-endian");

/// Distance of equal vertices, as part of the size of the surface
constexpr double same_place = 1e-6;
constexpr std::size_t stl_head = 84, stl_triangle = 50;

using Corner = std::array<double, 3>;

/// Corners of triangles, three after three.
using Corners = std::vector<Corner>;

[[noreturn]] void refuse(const std::string& path, std::size_t line, const std::string& message) {
  throw CaseError({path, static_cast<int>(line)}, "", message);
}

std::string read_bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw CaseError({path}, "", std::string("cannot read the mesh: ") + std::strerror(errno));
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// A binary .stl: a header, the number of triangles, and for each its normal, three corners and two
/// bytes.
bool is_binary_stl(const std::string& bytes) {
  if (bytes.size() < stl_head)
    return false;
  std::uint32_t n = 0;
  std::memcpy(&n, bytes.data() + stl_head - sizeof n, sizeof n);
  return bytes.size() == stl_head + stl_triangle * n;
}

Corner checked(const Corner& corner, const std::string& path, std::size_t line) {
  for (const double x : corner)
    if (!(std::abs(x) < hull::farthest)) {
      const std::string text = number_text(x) + " m is no place of a vertex; give a finite number";
      if (line > 0)
        refuse(path, line, text);
      throw CaseError({path}, "", text);
    }
  return corner;
}

Corners binary_stl(const std::string& bytes, const std::string& path) {
  Corners out;
  for (std::size_t at = stl_head; at < bytes.size(); at += stl_triangle)
    for (std::size_t k = 1; k <= 3; ++k) {
      std::array<float, 3> place{};
      std::memcpy(place.data(), bytes.data() + at + k * sizeof place, sizeof place);
      out.push_back(checked({place[0], place[1], place[2]}, path, 0));
    }
  return out;
}

Corner read_corner(std::istringstream& words, const std::string& path, std::size_t line) {
  Corner out{};
  for (double& x : out)
    if (!(words >> x))
      refuse(path, line, "expected three numbers, the place of a vertex");
  return checked(out, path, line);
}

Corners text_stl(const std::string& bytes, const std::string& path) {
  Corners out;
  std::istringstream text(bytes);
  std::string row, word;
  std::size_t line = 0, before = 0;
  while (std::getline(text, row)) {
    ++line;
    std::istringstream words(row);
    if (!(words >> word))
      continue;
    if (word == "vertex") {
      out.push_back(read_corner(words, path, line));
    } else if (word == "endloop") {
      if (out.size() != before + 3)
        refuse(path, line, "a loop of an .stl file has three vertices");
      before = out.size();
    }
  }
  return out;
}

/// "7", "7/1/2" or "-1" of a line "f", as a place in the list of `n` vertices.
std::size_t vertex_number(const std::string& word, std::size_t n, const std::string& path,
                          std::size_t line) {
  std::istringstream digits(word.substr(0, word.find('/')));
  long number = 0;
  const bool read = static_cast<bool>(digits >> number);
  const long index = number < 0 ? static_cast<long>(n) + number : number - 1;
  if (!read || index < 0 || index >= static_cast<long>(n))
    refuse(path, line,
           "'" + word + "' names none of the " + std::to_string(n) + " vertices that come before");
  return static_cast<std::size_t>(index);
}

Corners obj(const std::string& bytes, const std::string& path) {
  Corners vertices, out;
  std::istringstream text(bytes);
  std::string row, word;
  std::size_t line = 0;
  while (std::getline(text, row)) {
    ++line;
    std::istringstream words(row);
    if (!(words >> word))
      continue;
    if (word == "v") {
      vertices.push_back(read_corner(words, path, line));
    } else if (word == "f") {
      std::vector<std::size_t> polygon;
      while (words >> word)
        polygon.push_back(vertex_number(word, vertices.size(), path, line));
      if (polygon.size() < 3)
        refuse(path, line, "a face needs three vertices or more");
      for (std::size_t k = 2; k < polygon.size(); ++k)
        for (const std::size_t v : {polygon[0], polygon[k - 1], polygon[k]})
          out.push_back(vertices[v]);
    }
  }
  return out;
}

/// Gives each place one number, and leaves out triangles of which two corners are one.
Surface join(const Corners& corners) {
  double size = 0.0;
  for (const Corner& c : corners)
    for (const double x : c)
      size = std::max(size, std::abs(x));
  const double unit = size > 0.0 ? same_place * size : 1.0;
  std::map<std::array<long long, 3>, int> numbers;
  Corners places;
  std::vector<int> rows;
  for (std::size_t k = 0; k + 2 < corners.size(); k += 3) {
    std::array<int, 3> triangle{};
    for (std::size_t j = 0; j < 3; ++j) {
      const Corner& c = corners[k + j];
      const std::array<long long, 3> key = {std::llround(c[0] / unit), std::llround(c[1] / unit),
                                            std::llround(c[2] / unit)};
      const auto [entry, fresh] = numbers.try_emplace(key, static_cast<int>(places.size()));
      if (fresh)
        places.push_back(c);
      triangle[j] = entry->second;
    }
    if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0])
      rows.insert(rows.end(), triangle.begin(), triangle.end());
  }
  Surface out;
  out.vertices.resize(static_cast<Index>(places.size()), 3);
  for (std::size_t k = 0; k < places.size(); ++k)
    for (std::size_t j = 0; j < 3; ++j)
      out.vertices(static_cast<Index>(k), static_cast<Index>(j)) = places[k][j];
  out.triangles = Eigen::Map<const hull::Triangles>(rows.data(), std::ssize(rows) / 3, 3);
  return out;
}

bool ends_with(const std::string& path, std::string_view end) {
  return path.size() >= end.size() && path.substr(path.size() - end.size()) == end;
}

} // namespace

Surface read_surface(const std::string& path) {
  const bool stl = ends_with(path, ".stl") || ends_with(path, ".STL");
  if (!stl && !ends_with(path, ".obj") && !ends_with(path, ".OBJ"))
    throw CaseError({path}, "",
                    "a mesh is an .stl or .obj file; 'hydrodae hdb hull FILE -o hull.stl' makes "
                    "one of .gdf, .pnl and others");
  const std::string bytes = read_bytes(path);
  const Corners corners = !stl                   ? obj(bytes, path)
                          : is_binary_stl(bytes) ? binary_stl(bytes, path)
                                                 : text_stl(bytes, path);
  if (corners.empty())
    throw CaseError({path}, "", "there is no triangle in this file");
  Surface surface = join(corners);
  if (surface.triangles.rows() == 0)
    throw CaseError({path}, "",
                    "no triangle is left: vertices nearer to each other than 1e-6 of the size of "
                    "the surface are one; is one of them far away?");
  return surface;
}

} // namespace hydrodae::io
