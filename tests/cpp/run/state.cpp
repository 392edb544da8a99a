/// States as bytes and as files: what went in comes out, and nothing else is taken for one.

#include "hydrodae/run/state.h"

#include <doctest/doctest.h>

#include <deque>
#include <filesystem>
#include <fstream>
#include <limits>

#include "hydrodae/io/memory_file.h"

using namespace hydrodae;

namespace {

run::State example() {
  run::State s;
  s.time = 0.1 + 0.2;
  s.y = VectorX::LinSpaced(5, -1.0, 1.0 / 3.0);
  s.yp = VectorX::Constant(5, std::numeric_limits<double>::denorm_min());
  s.memory = {{"empty", {}}, {"run", {INFINITY, -0.0, 1e300}}};
  s.scene = "some scene";
  return s;
}

struct Part {
  int count = 0;
  bool flag = false;
  std::optional<double> maybe;
  std::vector<VectorX> vectors;
  MatrixX matrix;
  std::deque<std::pair<double, VectorX>> past;
  void remember(Archive& a) { a(count, flag, maybe, vectors, matrix, past); }
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

TEST_CASE("parts are restored as they were saved") {
  Part a;
  a.count = -7;
  a.flag = true;
  a.maybe = 0.5;
  a.vectors = {VectorX::Ones(2), VectorX()};
  a.matrix = MatrixX::Random(3, 2);
  a.past.emplace_back(1.0, VectorX::Zero(3));
  Memory memory;
  save(memory, "part", a);
  Part b;
  b.vectors.resize(9);
  restore(memory, "part", b);
  CHECK(b.count == -7);
  CHECK(b.flag);
  CHECK(b.maybe == 0.5);
  CHECK(b.vectors == a.vectors);
  CHECK(b.matrix == a.matrix);
  CHECK(b.past == a.past);
  memory["part"].push_back(0.0);
  CHECK_THROWS_AS(restore(memory, "part", b), Error);
  memory["part"].resize(4);
  CHECK_THROWS_AS(restore(memory, "part", b), Error);
  CHECK_THROWS_AS(restore(memory, "none", b), Error);
}

TEST_CASE("a file of numbers is replaced in one step") {
  const std::string path =
      (std::filesystem::temp_directory_path() / "hydrodae_memory_file.h5").string();
  io::MemoryFile file;
  file.texts["format"] = "example";
  file.groups["state"] = example().numbers();
  io::write_memory(path, file);
  file.groups["output"] = {{"rows", {1.0}}};
  io::write_memory(path, file);
  const io::MemoryFile back = io::read_memory(path);
  CHECK(back.texts == file.texts);
  CHECK(back.groups == file.groups);
  CHECK_FALSE(std::filesystem::exists(path + ".new"));
  std::ofstream(path) << "no HDF5";
  CHECK_THROWS_AS(io::read_memory(path), CaseError);
  std::filesystem::remove(path);
  CHECK_THROWS_AS(io::write_memory("/no/such/folder/x.h5", file), CaseError);
}
