#pragma once
/// The archive that an FMU is.

#include <filesystem>
#include <string>
#include <vector>

namespace hydrodae::cosim {

/// modelDescription.xml of an FMU. Throws CaseError where the file is no zip archive or lacks it.
std::string read_model_description(const std::string& path);

/// Names of all files inside.
std::vector<std::string> list_files(const std::string& path);

/// The files of an FMU in a temporary folder, which goes with this object.
class UnpackedFmu {
public:
  /// Unpacks modelDescription.xml, resources and what stands in the folder `binaries`.
  /// @param binaries  "binaries/linux64/"
  /// Throws CaseError where a file is damaged, or would not stay inside the folder.
  UnpackedFmu(const std::string& path, const std::string& binaries);
  UnpackedFmu(const UnpackedFmu&) = delete;
  UnpackedFmu& operator=(const UnpackedFmu&) = delete;
  ~UnpackedFmu();

  const std::filesystem::path& folder() const { return folder_; }

private:
  void discard() const;
  std::filesystem::path folder_;
};

} // namespace hydrodae::cosim
