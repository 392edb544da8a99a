#pragma once
/// What several tests use.

#include <doctest/doctest.h>

#include <filesystem>
#include <random>
#include <string>

#include "hydrodae/core/error.h"
#include "hydrodae/io/case_reader.h"
#include "hydrodae/model/scene.h"

namespace hydrodae::tests {

/// An empty folder that goes with the object.
class TemporaryFolder {
public:
  TemporaryFolder() {
    path_ = std::filesystem::temp_directory_path() /
            ("hydrodae-test-" + std::to_string(std::random_device{}()));
    std::filesystem::create_directory(path_);
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::string path() const { return path_.string(); }

private:
  std::filesystem::path path_;
};

/// What the Error says that `call` throws.
template <class Call> std::string message_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

/// "key: message" of what `check` says about a scene, "" if it is content.
inline std::string verdict(const model::Scene& scene) {
  try {
    model::check(scene);
  } catch (const ModelError& error) {
    return error.key + ": " + error.what();
  }
  return "";
}

/// The same for a scene of one body.
inline std::string verdict(const model::Body& body) {
  model::Scene scene;
  scene.bodies = {body};
  return verdict(scene);
}

/// `text` with the one place where it holds `old` replaced.
inline std::string replaced(std::string text, const std::string& old, const std::string& by) {
  const std::size_t at = text.find(old);
  REQUIRE_MESSAGE(at != std::string::npos, "not in the text: " << old);
  return text.replace(at, old.size(), by);
}

/// The scene of a case's text.
inline model::Scene read(const std::string& text, const io::Overrides& overrides = {}) {
  return io::parse_case(text, ".", overrides, "case.toml");
}

/// A change of a case, and what must be said about it.
struct BadInput {
  std::string old, by, message;
};

inline model::Body bar(const std::string& name, const Vector3& center,
                       const std::string& motion = "rigid") {
  model::Body body;
  body.name = name;
  body.motion = {motion};
  body.mass = 2.0;
  body.center_of_gravity = center;
  body.inertia = Vector3(0.1, 0.2, 0.15);
  return body;
}

inline model::Joint pin(const std::string& name, const std::string& a, const std::string& b,
                        const Vector3& point, const Vector3& axis = Vector3::UnitY()) {
  model::Joint joint;
  joint.name = name;
  joint.type = "revolute";
  joint.body_a = a;
  joint.body_b = b;
  joint.point = point;
  joint.axis = axis;
  return joint;
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A dry case: a flap that is hinged to a fixed base, with a power take-off.
inline const std::string flap_case = R"(title = "flap"

[environment]
gravity = 9.81

[[body]]
name = "base"
motion = "fixed"
mass = 100.0
center_of_gravity = [0.0, 0.0, -5.0]

[[body]]
name = "flap"
motion = "planar"
mass = 10.0
center_of_gravity = [0.0, 0.0, -2.0]
inertia = [1.0, 2.0, 3.0]

[[joint]]
name = "hinge"
type = "revolute"
body_a = "base"
body_b = "flap"
point = [0.0, 0.0, -4.0]
axis = [0.0, 1.0, 0.0]
initial = { angle_deg = 90.0 }

[[force]]
name = "pto1"
type = "pto_linear"
joint = "hinge"
damping = 5.0

[solver]
end_time = 10.0

[output]
step = 0.5
)";

} // namespace hydrodae::tests
