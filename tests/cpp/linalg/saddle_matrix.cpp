/// Factors of the saddle-point matrix that are kept while its values stay.

#include "hydrodae/linalg/saddle_matrix.h"
#include "hydrodae/build/build.h"

#include <doctest/doctest.h>

#include "../../property/scenes.h"

using namespace hydrodae;

TEST_CASE("factors of the masses follow the values, kept or not") {
  test::Random random;
  for (const joint::JointType& type : joint::joint_types()) {
    CAPTURE(std::string(type.name));
    model::Scene scene = test::two_bodies(type, {"planar"}, random);
    test::add_hydro(scene, "mean", "exponential", random);
    const system::System built = build::build(scene);
    const system::Regime s(built);
    const system::Pattern part = system::find_pattern(s, system::Part::accelerations);
    system::JacobianWorkspace ws(s);
    system::JacobianParts parts(part);
    linalg::SaddleMatrix kept(s, part);
    const VectorX here = system::initial_state(s), yp = VectorX::Zero(s.n);
    VectorX there = here;
    for (Index i = 0; i < s.n_q; ++i)
      there[i] += 0.1 * random();
    VectorX b(s.n_u + s.n_lambda), x(b.size()), wanted(b.size());
    for (Index i = 0; i < b.size(); ++i)
      b[i] = i < s.n_u ? std::sin(1.0 + static_cast<double>(i)) : 0.0;
    for (const VectorX* y :
         std::initializer_list<const VectorX*>{&here, &here, &there, &there, &here}) {
      system::jacobian(s, part, ws, 0.0, y->data(), yp.data(), parts);
      linalg::SaddleMatrix fresh(s, part);
      for (linalg::SaddleMatrix* matrix : {&kept, &fresh}) {
        matrix->fill(parts);
        REQUIRE(matrix->factorise());
        matrix->solve(b, matrix == &kept ? x : wanted);
      }
      CHECK((x - wanted).head(s.n_u).norm() <= 1e-10 * wanted.head(s.n_u).norm());
    }
  }
}
