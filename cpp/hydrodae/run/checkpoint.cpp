#include "hydrodae/run/checkpoint.h"

#include <cstdio>
#include <filesystem>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/io/byte_file.h"
#include "hydrodae/io/output_place.h"
#include "hydrodae/io/sha256.h"

namespace hydrodae::run {

namespace {

io::Texts identity(const model::Scene& scene) {
  return {{"format", "hydrodae-checkpoint 2"},
          {"version", HYDRODAE_VERSION},
          {"case_text", scene.text},
          {"case_overrides", joined(scene.overrides, "\n")},
          {"input_files", model::text_of_files(scene.files)}};
}

bool is_checkpoint(const std::string& path) {
  try {
    return io::read_texts(path)["format"].starts_with("hydrodae-checkpoint");
  } catch (const CaseError&) { // not HDF5, or truncated
    return false;
  }
}

/// Throws CaseError that names the first item that differs from the scene.
void check_identity(const std::string& path, const io::Texts& found, const model::Scene& scene) {
  static const std::map<std::string, std::string> words = {
      {"format", "is no checkpoint of this version of hydrodae"},
      {"version", "was made by another version of hydrodae"},
      {"case_text", "is of another case: its text has changed since"},
      {"case_overrides", "is of a run with other overrides (--set, --method)"},
      {"input_files", "is of a run with other inputs"}};
  for (const std::string name :
       {"format", "version", "case_overrides", "case_text", "input_files"}) {
    const auto entry = found.find(name);
    const std::string expected = identity(scene).at(name);
    if (entry == found.end() || entry->second != expected)
      throw CaseError(path + ": cannot be resumed: it " + words.at(name) +
                      (entry == found.end() ? ""
                       : name == "version"  ? " (" + entry->second + ", this is " + expected + ")"
                       : name == "input_files" ? ": " + model::changed_file(entry->second, expected)
                                               : ""));
  }
}

} // namespace

std::string checkpoint_name(const std::string& results) {
  return io::name_beside(results, "checkpoint");
}

void write_checkpoint(const std::string& results, const model::Scene& scene,
                      const Checkpoint& checkpoint) {
  io::ByteFile file{identity(scene), to_bytes(checkpoint)};
  file.texts["time"] = number_text(checkpoint.state.time);
  file.texts["sha256"] = io::sha256_of_text(file.bytes); // damage is reported before a run goes on
  try {
    io::write_bytes(checkpoint_name(results), file);
  } catch (const CaseError& error) {
    throw SolverError(checkpoint.state.time, {Reason::output, error.what()});
  }
}

Checkpoint read_checkpoint(const std::string& results, const model::Scene& scene) {
  const std::string path = checkpoint_name(results);
  if (!std::filesystem::exists(path))
    throw CaseError(path + ": does not exist: there is nothing to resume; a run with --checkpoint "
                           "leaves it when it is cut off");
  const io::ByteFile file = io::read_bytes(path);
  check_identity(path, file.texts, scene);
  try {
    const auto sum = file.texts.find("sha256");
    if (sum != file.texts.end() && sum->second == io::sha256_of_text(file.bytes))
      return from_bytes<Checkpoint>(file.bytes);
  } catch (const Error&) { // bytes of another kind
  }
  throw CaseError(path + ": cannot be resumed: it is damaged");
}

void require_checkpoint_place(const std::string& results) {
  const std::string path = checkpoint_name(results);
  if (std::filesystem::exists(path) && !is_checkpoint(path))
    throw CaseError(path + ": exists and is no checkpoint of hydrodae; it is not replaced: give "
                           "the results another name, or remove it");
}

void remove_checkpoint(const std::string& results) {
  const std::string path = checkpoint_name(results);
  if (std::filesystem::exists(path) && is_checkpoint(path))
    std::remove(path.c_str());
}

} // namespace hydrodae::run
