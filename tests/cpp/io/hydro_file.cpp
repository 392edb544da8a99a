#include "hydrodae/io/hydro_file.h"

#include <cmath>
#include <complex>
#include <fstream>
#include <functional>
#include <limits>

#include "hydrodae/io/hdf5.h"
#include "hydrodae/io/sha256.h"
#include "support.h"

using namespace hydrodae;
using namespace hydrodae::tests;
using io::hdf5::Handle;
using Complex = std::complex<double>;

namespace {

/// Writes a small hydro.h5 by hand; each function is one object of the file.
class Writer {
public:
  Writer(const std::string& path, bool create)
      : file_(create ? H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT)
                     : H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT),
              H5Fclose) {}

  void group(const char* path) {
    const Handle id(H5Gcreate2(file_, path, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  }
  void remove(const char* path) { REQUIRE(H5Ldelete(file_, path, H5P_DEFAULT) >= 0); }

  template <class T>
  void attribute(const char* object, const char* name, hid_t type, const T* data,
                 std::vector<hsize_t> shape) {
    const Handle owner(H5Oopen(file_, object, H5P_DEFAULT), H5Oclose);
    if (H5Aexists(owner, name) > 0)
      H5Adelete(owner, name);
    const Handle space = simple(shape);
    const Handle id(H5Acreate2(owner, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    REQUIRE(H5Awrite(id, type, data) >= 0);
  }
  void number(const char* object, const char* name, double value) {
    attribute(object, name, H5T_NATIVE_DOUBLE, &value, {});
  }
  void integer(const char* object, const char* name, int value) {
    attribute(object, name, H5T_NATIVE_INT, &value, {});
  }
  void text(const char* object, const char* name, const char* value) {
    const Handle type = io::hdf5::text_type();
    attribute(object, name, type, &value, {});
  }
  /// A bool of h5py: an enumeration of FALSE and TRUE.
  void truth(const char* object, const char* name, bool value) {
    const Handle type(H5Tenum_create(H5T_NATIVE_INT8), H5Tclose);
    const std::int8_t no = 0, yes = 1, stored = value ? 1 : 0;
    H5Tenum_insert(type, "FALSE", &no);
    H5Tenum_insert(type, "TRUE", &yes);
    attribute(object, name, type, &stored, {});
  }

  template <class T>
  void dataset(const char* path, hid_t type, const std::vector<T>& data,
               std::vector<hsize_t> shape) {
    if (H5Lexists(file_, path, H5P_DEFAULT) > 0)
      H5Ldelete(file_, path, H5P_DEFAULT);
    const Handle space = simple(shape);
    const Handle id(H5Dcreate2(file_, path, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                    H5Dclose);
    REQUIRE(H5Dwrite(id, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data.data()) >= 0);
  }
  void numbers(const char* path, const std::vector<double>& data, std::vector<hsize_t> shape) {
    dataset(path, H5T_NATIVE_DOUBLE, data, std::move(shape));
  }
  void complex(const char* path, const std::vector<Complex>& data, std::vector<hsize_t> shape) {
    const Handle type(H5Tcreate(H5T_COMPOUND, sizeof(Complex)), H5Tclose);
    H5Tinsert(type, "r", 0, H5T_NATIVE_DOUBLE);
    H5Tinsert(type, "i", sizeof(double), H5T_NATIVE_DOUBLE);
    dataset(path, type, data, std::move(shape));
  }
  void labels(const char* path, const std::vector<std::string>& names, std::size_t length = 32) {
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type, length);
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    std::vector<char> data(names.size() * length, '\0');
    for (std::size_t i = 0; i < names.size(); ++i)
      names[i].copy(data.data() + i * length, length);
    dataset(path, type, data, {names.size()});
  }

private:
  static Handle simple(const std::vector<hsize_t>& shape) {
    return {H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose};
  }
  Handle file_;
};

const std::vector<std::string> labels = {"float.surge", "float.heave", "base.surge"};

std::vector<double> stiffness() {
  std::vector<double> values(36);
  for (std::size_t i = 0; i < 36; ++i)
    values[i] = static_cast<double>(i);
  return values;
}

void write_file(const std::string& path) {
  Writer file(path, true);
  file.text("/", "format", "hydrodae-hydro");
  file.integer("/", "format_version", 1);
  file.number("/", "rho", 1025.0);
  file.number("/", "gravity", 9.81);
  file.number("/", "water_depth", std::numeric_limits<double>::infinity());
  file.labels("/coordinates", labels);
  file.numbers("/added_mass_inf", {1, 2, 3, 4, 5, 6, 7, 8, 9}, {3, 3});
  file.group("/bodies");
  file.group("/bodies/base");
  file.group("/bodies/float");
  const std::vector<double> point = {1, 2, -3};
  file.integer("/bodies/float", "index", 0);
  file.integer("/bodies/base", "index", 1);
  for (const char* body : {"/bodies/float", "/bodies/base"})
    file.attribute(body, "reference_point", H5T_NATIVE_DOUBLE, point.data(), {3});
  file.number("/bodies/float", "displaced_volume", 12.5);
  file.attribute("/bodies/float", "center_of_buoyancy", H5T_NATIVE_DOUBLE, point.data(), {3});
  file.numbers("/bodies/float/hydrostatic_stiffness", stiffness(), {6, 6});
  file.group("/memory");
  file.group("/memory/heave");
  file.labels("/memory/heave/inputs", {"float.heave"}, 11);
  file.labels("/memory/heave/outputs", {"float.heave", "base.surge"});
  file.complex("/memory/heave/poles", {{-1, 0}, {-2, 3}}, {2});
  file.complex("/memory/heave/input_matrix", {{1, 0}, {2, 3}}, {2, 1});
  file.complex("/memory/heave/output_matrix", {{1, 0}, {2, 3}, {4, 0}, {5, 6}}, {2, 2});
  file.numbers("/memory/heave/added_mass_inf", {10, 20}, {2, 1});
  file.truth("/memory/heave", "passive", true);
  file.integer("/memory/heave", "n_states", 3);
}

/// What is said about a file with one change.
std::string message_with(const std::function<void(Writer&)>& change) {
  const TemporaryFolder folder;
  const std::string path = folder / "hydro.h5";
  write_file(path);
  {
    Writer file(path, false);
    change(file);
  }
  return replaced(message_of([&] { io::read_hydro_file(path); }), folder.path() + "/", "");
}

} // namespace

TEST_CASE("a hydro file becomes a database") {
  const TemporaryFolder folder;
  const std::string path = folder / "hydro.h5";
  write_file(path);
  const hydro::Database db = io::read_hydro_file(path);
  CHECK(db.path == path);
  CHECK(db.rho == 1025.0);
  CHECK(std::isinf(db.water_depth));
  CHECK(db.coordinates == labels);
  CHECK(db.added_mass_inf(0, 1) == 2.0);
  CHECK(db.added_mass_inf(2, 0) == 7.0);
  CHECK(db.bodies[0].name == "float"); // by index, not by name
  CHECK(db.bodies[1].name == "base");
  CHECK(db.bodies[0].reference_point == Vector3(1, 2, -3));
  CHECK(db.bodies[0].hydrostatics->displaced_volume == 12.5);
  CHECK(db.bodies[0].hydrostatics->stiffness(1, 2) == 8.0);
  CHECK_FALSE(db.bodies[1].hydrostatics.has_value());
  const hydro::MemoryFit& fit = db.fits.at(0);
  CHECK(fit.name == "heave");
  CHECK(fit.inputs == std::vector<std::string>{"float.heave"});
  CHECK(fit.outputs == std::vector<std::string>{"float.heave", "base.surge"});
  CHECK(fit.states == 3);
  CHECK(fit.passive);
  CHECK(fit.poles[1] == Complex(-2, 3));
  CHECK(fit.input_matrix(1, 0) == Complex(2, 3));
  CHECK(fit.output_matrix(0, 1) == Complex(2, 3));
  CHECK(fit.output_matrix(1, 0) == Complex(4, 0));
  CHECK(fit.added_mass_inf(1, 0) == 20.0);
}

TEST_CASE("the hash of a file") {
  const TemporaryFolder folder;
  std::ofstream(folder / "abc") << "abc"; // FIPS 180-2, appendix B.1
  CHECK(io::sha256_of_file(folder / "abc") ==
        "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST_CASE("a hydro file that cannot be used is told") {
  const TemporaryFolder folder;
  const std::string path = folder / "text.h5";
  CHECK(message_of([&] { io::read_hydro_file(path); }) == path + ": no such file");
  std::ofstream(path) << "no HDF5";
  CHECK(message_of([&] { io::read_hydro_file(path); }) == path + ": not an HDF5 file");

  CHECK(message_with([](Writer& f) { f.text("/", "format", "other"); }) ==
        "hydro.h5: /: not a hydrodae-hydro file; make one with: hydrodae hdb import");
  CHECK(contains(message_with([](Writer& f) { f.integer("/", "format_version", 2); }),
                 "format_version is 2, this program reads 1"));
  CHECK(message_with([](Writer& f) { f.number("/", "gravity", 0.0); }) ==
        "hydro.h5: /: gravity must be > 0, is 0");
  CHECK(message_with([](Writer& f) { f.text("/", "rho", "much"); }) ==
        "hydro.h5: /: attribute 'rho': expected numbers, found another type");
  CHECK(message_with([](Writer& f) { f.remove("/added_mass_inf"); }) ==
        "hydro.h5: /added_mass_inf: missing dataset");
  CHECK(message_with([](Writer& f) { f.numbers("/added_mass_inf", {1, 2, 3}, {3, 1}); }) ==
        "hydro.h5: /added_mass_inf: expected shape (3, 3), found (3, 1)");
  CHECK(message_with([](Writer& f) {
          f.numbers("/added_mass_inf", std::vector<double>(9, std::nan("")), {3, 3});
        }) == "hydro.h5: /added_mass_inf: holds values that are not finite");
  CHECK(message_with([](Writer& f) {
          f.labels("/coordinates", {"float.surge", "float.surge", "base.surge"});
        }) == "hydro.h5: /coordinates: 'float.surge' stands there twice");
  CHECK(message_with([](Writer& f) {
          f.labels("/coordinates", {"float.surge", "float.heave", "bas.surge"});
        }) == "hydro.h5: /coordinates: 'bas.surge' belongs to no group of /bodies");
  CHECK(message_with([](Writer& f) { f.remove("/bodies/float/hydrostatic_stiffness"); }) ==
        "hydro.h5: /bodies/float/hydrostatic_stiffness: missing dataset");
}

TEST_CASE("a memory fit that cannot be right is told") {
  CHECK(message_with([](Writer& f) { f.complex("/memory/heave/poles", {{-1, 0}, {2, 3}}, {2}); }) ==
        "hydro.h5: /memory/heave/poles: pole 2 + 3i 1/s does not decay (Re < 0)");
  CHECK(message_with([](Writer& f) {
          f.complex("/memory/heave/poles", {{-1, 0}, {-2, -3}}, {2});
        }).ends_with("must have Im >= 0"));
  CHECK(message_with([](Writer& f) {
          f.complex("/memory/heave/poles", {{-1, 0}, {-2, 0}}, {2});
        }).ends_with("is real, but its input or output coefficients are not"));
  CHECK(message_with([](Writer& f) { f.integer("/memory/heave", "n_states", 4); }) ==
        "hydro.h5: /memory/heave: n_states is 4, the poles make 3");
  CHECK(message_with([](Writer& f) { f.labels("/memory/heave/inputs", {"float.surge"}); }) ==
        "hydro.h5: /memory/heave/inputs: 'float.surge' is not among the outputs");
  CHECK(message_with([](Writer& f) {
          f.labels("/memory/heave/outputs", {"float.heave", "base.sway"});
        }) == "hydro.h5: /memory/heave/outputs: 'base.sway' is not in /coordinates");
  CHECK(message_with([](Writer& f) { f.numbers("/memory/heave/poles", {-1, -2}, {2}); }) ==
        "hydro.h5: /memory/heave/poles: expected complex numbers (a compound of r and i), found "
        "another type");
  CHECK(message_with([](Writer& f) {
          f.complex("/memory/heave/input_matrix", {{1, 0}, {2, 3}}, {1, 2});
        }) == "hydro.h5: /memory/heave/input_matrix: expected shape (2, 1), found (1, 2)");
}
