#include "hydrodae/run/checkpoint.h"

#include <cstdio>
#include <filesystem>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/io/memory_file.h"
#include "hydrodae/io/output_place.h"
#include "hydrodae/io/sha256.h"

namespace hydrodae::run {

namespace {

constexpr const char *of_state = "state", *of_output = "output", *of_second = "second";

/// SHA-256 of all numbers: damage is reported before a run goes on from it.
std::string digest_of_numbers(const Checkpoint& checkpoint) {
  State output;
  output.memory = checkpoint.output;
  return io::sha256_of_text(checkpoint.state.bytes() + output.bytes() +
                            (checkpoint.second ? checkpoint.second->bytes() : ""));
}

io::Texts identity(const model::Scene& scene) {
  return {{"format", "hydrodae-checkpoint 1"},
          {"version", HYDRODAE_VERSION},
          {"case_text", scene.text},
          {"case_overrides", joined(scene.overrides, "\n")},
          {"input_files", model::text_of_files(scene.files)}};
}

bool is_checkpoint(const std::string& path) {
  try {
    return io::read_texts(path)["format"].starts_with("hydrodae-checkpoint");
  } catch (const CaseError&) { // no HDF5, or cut off
    return false;
  }
}

/// Throws CaseError naming what is not that of the scene.
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
  io::MemoryFile file;
  file.texts = identity(scene);
  file.texts["scene"] = checkpoint.state.scene;
  file.texts["sha256"] = digest_of_numbers(checkpoint);
  file.groups[of_state] = checkpoint.state.numbers();
  file.groups[of_output] = checkpoint.output;
  if (checkpoint.second)
    file.groups[of_second] = checkpoint.second->numbers();
  file.texts["verify"] = checkpoint.verify;
  file.texts["stopped"] = checkpoint.stopped;
  try {
    io::write_memory(checkpoint_name(results), file);
  } catch (const CaseError& error) {
    throw SolverError(checkpoint.state.time, {Reason::output, error.what()});
  }
}

Checkpoint read_checkpoint(const std::string& results, const model::Scene& scene) {
  const std::string path = checkpoint_name(results);
  if (!std::filesystem::exists(path))
    throw CaseError(path + ": does not exist: there is nothing to resume; a run with --checkpoint "
                           "leaves it when it is cut off");
  io::MemoryFile file = io::read_memory(path);
  check_identity(path, file.texts, scene);
  try {
    Checkpoint out{State::from_numbers(std::move(file.groups[of_state]), file.texts["scene"]),
                   std::move(file.groups[of_output]), std::nullopt, file.texts["verify"],
                   file.texts["stopped"]};
    if (file.groups.contains(of_second))
      out.second = State::from_numbers(std::move(file.groups[of_second]), out.state.scene);
    if (digest_of_numbers(out) == file.texts["sha256"])
      return out;
  } catch (const Error&) { // parts of it are missing
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
