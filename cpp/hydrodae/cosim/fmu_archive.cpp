#include "hydrodae/cosim/fmu_archive.h"

#include <array>
#include <cstdlib>
#include <fstream>
#include <functional>

#include <unzip.h>

#include "hydrodae/core/error.h"
#include "hydrodae/cosim/foreign_text.h"

namespace hydrodae::cosim {

namespace {

constexpr const char* description_file = "modelDescription.xml";

/// Bytes of one file that are taken: a damaged or hostile archive may unpack to more than there is
/// room for.
constexpr std::streamsize longest_description = std::streamsize{1} << 28;
constexpr std::streamsize longest_file = std::streamsize{1} << 32;

/// A zip archive that is read from its first file to its last.
class ZipReader {
public:
  explicit ZipReader(const std::string& path) : path_(path), zip_(unzOpen64(path.c_str())) {
    if (!std::filesystem::is_regular_file(path))
      refuse("there is no such file");
    if (!zip_)
      refuse("is no zip archive, as an FMU is one");
  }
  ZipReader(const ZipReader&) = delete;
  ZipReader& operator=(const ZipReader&) = delete;
  ~ZipReader() { unzClose(zip_); }

  void each(const std::function<void(const std::string& name)>& visit) {
    for (int at = unzGoToFirstFile(zip_); at != UNZ_END_OF_LIST_OF_FILE;
         at = unzGoToNextFile(zip_)) {
      unz_file_info64 info;
      std::array<char, 4096> name{};
      if (at != UNZ_OK || unzGetCurrentFileInfo64(zip_, &info, name.data(), name.size() - 1,
                                                  nullptr, 0, nullptr, 0) != UNZ_OK)
        refuse("its list of files is damaged");
      visit(name.data());
    }
  }

  bool find(const char* name) { return unzLocateFile(zip_, name, 1) == UNZ_OK; }

  /// Gives the bytes of the file that it stands at to `take`, piece by piece.
  void read(const std::string& name, std::streamsize longest,
            const std::function<void(const char* bytes, std::streamsize size)>& take) {
    std::streamsize all = 0;
    std::array<char, 65536> piece;
    int size = unzOpenCurrentFile(zip_);
    if (size == UNZ_OK)
      while ((size = unzReadCurrentFile(zip_, piece.data(), piece.size())) > 0) {
        if ((all += size) > longest)
          refuse("its file " + name + " has more than " + std::to_string(longest) + " bytes");
        take(piece.data(), size);
      }
    if (size < 0 || unzCloseCurrentFile(zip_) != UNZ_OK) // the latter compares checksums
      refuse("its file " + name + " is damaged");
  }

  [[noreturn]] void refuse(const std::string& why) const {
    throw CaseError(path_ + ": " + foreign_text(why));
  }

private:
  std::string path_;
  unzFile zip_;
};

bool stays_inside(const std::filesystem::path& name) {
  if (name.is_absolute())
    return false;
  for (const std::filesystem::path& part : name)
    if (part == "..")
      return false;
  return true;
}

} // namespace

std::string read_model_description(const std::string& path) {
  ZipReader archive(path);
  if (!archive.find(description_file))
    archive.refuse(std::string("has no ") + description_file + ": it is no FMU");
  std::string text;
  archive.read(description_file, longest_description, [&](const char* bytes, std::streamsize size) {
    text.append(bytes, static_cast<std::size_t>(size));
  });
  return text;
}

std::vector<std::string> list_files(const std::string& path) {
  std::vector<std::string> out;
  ZipReader(path).each([&](const std::string& name) { out.push_back(name); });
  return out;
}

UnpackedFmu::UnpackedFmu(const std::string& path, const std::string& binaries) {
  ZipReader archive(path);
  std::string pattern = (std::filesystem::temp_directory_path() / "hydrodae-fmu-XXXXXX").string();
  if (!mkdtemp(pattern.data()))
    archive.refuse("no folder " + pattern + " can be made to unpack it");
  folder_ = pattern;
  try {
    archive.each([&](const std::string& name) {
      if (name.ends_with('/') || !(name == description_file || name.starts_with("resources/") ||
                                   name.starts_with(binaries)))
        return;
      if (!stays_inside(name))
        archive.refuse("its file " + name + " would be unpacked elsewhere");
      const std::filesystem::path place = folder_ / name;
      std::filesystem::create_directories(place.parent_path());
      std::ofstream out(place, std::ios::binary);
      archive.read(name, longest_file,
                   [&](const char* bytes, std::streamsize size) { out.write(bytes, size); });
      out.close();
      if (!out)
        archive.refuse("cannot be unpacked into " + folder_.string());
    });
    std::filesystem::create_directories(folder_ / "resources");
  } catch (const std::filesystem::filesystem_error& error) { // a file where a folder is to be, ...
    discard();
    archive.refuse("cannot be unpacked: " + std::string(error.what()));
  } catch (...) {
    discard();
    throw;
  }
}

UnpackedFmu::~UnpackedFmu() { discard(); }

void UnpackedFmu::discard() const {
  std::error_code ignored; // nobody could do anything about it
  std::filesystem::remove_all(folder_, ignored);
}

} // namespace hydrodae::cosim
