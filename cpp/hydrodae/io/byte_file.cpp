#include "hydrodae/io/byte_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "hydrodae/io/hdf5.h"
#include "hydrodae/io/hdf5_input.h"

namespace hydrodae::io {

namespace {

using hdf5::checked;
using hdf5::Handle;

void write_text(hid_t file, const std::string& name, const std::string& value,
                const std::string& what) {
  const Handle type = hdf5::text_type();
  const Handle space = checked(H5Screate(H5S_SCALAR), H5Sclose, what);
  const Handle attribute = checked(
      H5Acreate2(file, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, what);
  const char* characters = value.c_str();
  checked(H5Awrite(attribute, type, &characters), what);
}

constexpr const char* of_bytes = "state"; ///< name of the only dataset

void write_all(const std::string& path, const ByteFile& content, const std::string& what) {
  const Handle file =
      checked(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose, what);
  for (const auto& [name, value] : content.texts)
    write_text(file, name, value, what);
  const hsize_t size = content.bytes.size();
  const Handle space = checked(H5Screate_simple(1, &size, nullptr), H5Sclose, what);
  const Handle dataset = checked(
      H5Dcreate2(file, of_bytes, H5T_NATIVE_UINT8, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      H5Dclose, what);
  if (size > 0)
    checked(
        H5Dwrite(dataset, H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, H5P_DEFAULT, content.bytes.data()),
        what);
  checked(H5Fflush(file, H5F_SCOPE_LOCAL), what);
}

/// Writes the file to disk before it gets its name.
void require_on_disk(const std::string& path, const std::string& what) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool good = descriptor >= 0 && ::fsync(descriptor) == 0;
  const std::string why = std::strerror(errno);
  if (descriptor >= 0)
    ::close(descriptor);
  if (!good)
    throw CaseError(what + ": " + why);
}

} // namespace

void write_bytes(const std::string& path, const ByteFile& content) {
  const hdf5::Quiet quiet;
  const std::string what = path + ": cannot be written", beside = path + ".new";
  try {
    write_all(beside, content, what);
    require_on_disk(beside, what);
  } catch (const CaseError&) {
    std::remove(beside.c_str());
    throw;
  }
  if (std::rename(beside.c_str(), path.c_str()) != 0)
    throw CaseError(what + ": " + std::strerror(errno));
}

Texts read_texts(const std::string& path) {
  const hdf5::Input input(path);
  Texts out;
  for (const char* name :
       {"format", "version", "case_text", "case_overrides", "input_files", "sha256"})
    if (input.has_attribute("/", name))
      out[name] = input.text("/", name);
  return out;
}

ByteFile read_bytes(const std::string& path) {
  const std::string what = path + ": cannot be read";
  ByteFile out{read_texts(path), ""};
  const hdf5::Quiet quiet;
  const Handle file = checked(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, what);
  const Handle dataset = checked(H5Dopen2(file, of_bytes, H5P_DEFAULT), H5Dclose, what);
  const Handle space = checked(H5Dget_space(dataset), H5Sclose, what);
  const hssize_t size = checked(H5Sget_simple_extent_npoints(space), what);
  // Bytes written by us lie in the file as they are: a size beyond it is damage.
  if (size < 0 || H5Dget_storage_size(dataset) != static_cast<hsize_t>(size))
    throw CaseError(what + ": it is damaged");
  out.bytes.resize(static_cast<std::size_t>(size));
  if (size > 0)
    checked(H5Dread(dataset, H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, H5P_DEFAULT, out.bytes.data()),
            what);
  return out;
}

} // namespace hydrodae::io
