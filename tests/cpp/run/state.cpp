/// States as bytes and as files: what went in comes out, and nothing else is taken for one.

#include "hydrodae/run/state.h"

#include <doctest/doctest.h>

#include <deque>
#include <filesystem>
#include <fstream>
#include <limits>

#include "hydrodae/io/byte_file.h"

using namespace hydrodae;

namespace {

run::State example() {
  run::State s;
  s.time = 0.1 + 0.2;
  s.y = VectorX::LinSpaced(5, -1.0, 1.0 / 3.0);
  s.yp = VectorX::Constant(5, std::numeric_limits<double>::denorm_min());
  s.scene = "some scene";
  s.held.signals = {{INFINITY, -0.0, 1e300}, {}};
  s.methods.changes = {{run::MethodChange::Cause::guard, "radau", 0.5, "text of a reason", "ida"}};
  s.method = integrate::BdfState{10.0, 3, {7, 0.25}};
  s.history.emplace().pieces = {{0.0, 0.5, MatrixX::Random(2, 3)}};
  s.controllers.emplace_back().law = std::string("bytes\0behind", 12);
  return s;
}

struct Inner {
  int count = 0;
  std::optional<double> maybe;
};

struct Part {
  Inner inner;
  bool flag = false;
  std::vector<VectorX> vectors;
  MatrixX matrix;
  std::deque<std::pair<double, VectorX>> past;
  std::variant<Inner, std::string> either;
  std::string text;
};

} // namespace

TEST_CASE("a state comes back from its bytes") {
  const run::State s = example();
  CHECK(run::State::from_bytes(s.bytes()) == s);
}

TEST_CASE("other bytes are no state") {
  const std::string bytes = example().bytes();
  for (std::size_t length = 0; length < bytes.size(); ++length)
    CHECK_THROWS_AS(run::State::from_bytes(bytes.substr(0, length)), Error);
  CHECK_THROWS_AS(run::State::from_bytes("x" + bytes), Error);
  for (std::size_t place = 0; place < bytes.size(); place += 7) {
    std::string damaged = bytes;
    damaged[place] = static_cast<char>(damaged[place] ^ 4);
    CHECK_THROWS_AS(run::State::from_bytes(damaged), Error);
  }
}

TEST_CASE("a plain struct comes back from its bytes, member by member") {
  Part a;
  a.inner = {-7, 0.5};
  a.flag = true;
  a.vectors = {VectorX::Ones(2), VectorX()};
  a.matrix = MatrixX::Random(3, 2);
  a.past.emplace_back(1.0, VectorX::Zero(3));
  a.either = "one of two";
  a.text = "a text";
  const std::string bytes = to_bytes(a);
  const auto b = from_bytes<Part>(bytes);
  CHECK(b.inner.count == -7);
  CHECK(b.inner.maybe == 0.5);
  CHECK(b.flag);
  CHECK(b.vectors == a.vectors);
  CHECK(b.matrix == a.matrix);
  CHECK(b.past == a.past);
  CHECK(std::get<std::string>(b.either) == "one of two");
  CHECK(b.text == "a text");
  CHECK_THROWS_AS(from_bytes<Part>(bytes + "x"), Error);
  for (std::size_t length = 0; length < bytes.size(); ++length)
    CHECK_THROWS_AS(from_bytes<Part>(bytes.substr(0, length)), Error);
}

TEST_CASE("a text lies in a state as it is") {
  CHECK(example().bytes().find("text of a reason") != std::string::npos);
}

TEST_CASE("a file of bytes is replaced in one step") {
  const std::string path =
      (std::filesystem::temp_directory_path() / "hydrodae_byte_file.h5").string();
  io::ByteFile file{{{"format", "example"}}, ""};
  io::write_bytes(path, file);
  CHECK(io::read_bytes(path).bytes.empty());
  file.bytes = example().bytes();
  io::write_bytes(path, file);
  const io::ByteFile back = io::read_bytes(path);
  CHECK(back.texts == file.texts);
  CHECK(back.bytes == file.bytes);
  CHECK_FALSE(std::filesystem::exists(path + ".new"));
  std::ofstream(path) << "no HDF5";
  CHECK_THROWS_AS(io::read_bytes(path), CaseError);
  std::filesystem::remove(path);
  CHECK_THROWS_AS(io::write_bytes("/no/such/folder/x.h5", file), CaseError);
}
