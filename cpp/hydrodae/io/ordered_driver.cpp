#include "hydrodae/io/ordered_driver.h"

#include <exception>
#include <memory>

#include "hydrodae/io/ordered_file.h"
#if H5_VERSION_GE(1, 13, 0)
#include <H5FDdevelop.h>
#endif

namespace hydrodae::io {
namespace {

using hdf5::checked;
using hdf5::Handle;

/// Driver data of HDF5, with H5FD_t as the first member.
struct Driver {
  H5FD_t base{};
  OrderedFile* file = nullptr;
};

OrderedFile& file_of(H5FD_t* base) { return *reinterpret_cast<Driver*>(base)->file; }
const OrderedFile& file_of(const H5FD_t* base) {
  return *reinterpret_cast<const Driver*>(base)->file;
}

/// No exception may pass through HDF5, which is C; memory is all that can fail here.
template <class Call> herr_t guarded(const Call& call) noexcept {
  try {
    call();
    return 0;
  } catch (const std::exception&) {
    return -1;
  }
}

H5FD_t* open(const char*, unsigned, hid_t properties, haddr_t) {
  const void* info = H5Pget_driver_info(properties);
  std::unique_ptr<Driver> driver;
  const herr_t made = guarded([&] {
    driver = std::make_unique<Driver>();
    driver->file = *static_cast<OrderedFile* const*>(info);
  });
  return made < 0 ? nullptr : &driver.release()->base;
}

herr_t close(H5FD_t* base) {
  delete reinterpret_cast<Driver*>(base);
  return 0;
}

/// Metadata and raw data may be gathered in blocks of their own.
herr_t query(const H5FD_t*, unsigned long* flags) {
  *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

haddr_t get_eoa(const H5FD_t* base, H5FD_mem_t) { return file_of(base).end_of_space(); }

herr_t set_eoa(H5FD_t* base, H5FD_mem_t, haddr_t address) {
  file_of(base).set_end_of_space(address);
  return 0;
}

haddr_t get_eof(const H5FD_t* base, H5FD_mem_t) { return file_of(base).end_of_file(); }

herr_t read(H5FD_t* base, H5FD_mem_t, hid_t, haddr_t address, std::size_t size, void* out) {
  return guarded([&] { file_of(base).read(address, size, static_cast<unsigned char*>(out)); });
}

herr_t write(H5FD_t* base, H5FD_mem_t type, hid_t, haddr_t address, std::size_t size,
             const void* data) {
  return guarded(
      [&] { file_of(base).write(type, address, size, static_cast<const unsigned char*>(data)); });
}

H5FD_class_t driver_class() {
  H5FD_class_t c{};
#if H5_VERSION_GE(1, 13, 0)
  c.version = H5FD_CLASS_VERSION;
  c.value = 520; // of the range for private drivers
#endif
  c.name = "hydrodae_ordered";
  c.maxaddr = HADDR_MAX / 2;
  c.fc_degree = H5F_CLOSE_STRONG;
  c.fapl_size = sizeof(OrderedFile*);
  c.open = open;
  c.close = close;
  c.query = query;
  c.get_eoa = get_eoa;
  c.set_eoa = set_eoa;
  c.get_eof = get_eof;
  c.read = read;
  c.write = write;
  for (H5FD_mem_t& type : c.fl_map)
    type = H5FD_MEM_DEFAULT; // no space is handed from one kind to another
  return c;
}

} // namespace

Handle ordered_access_properties(OrderedFile& file) {
  static const H5FD_class_t description = driver_class();
  static const hid_t driver = H5FDregister(&description); // for as long as the process lives
  const std::string what = "HDF5 file driver";
  checked(driver, what);
  Handle properties = checked(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, what);
  OrderedFile* pointer = &file;
  checked(H5Pset_driver(properties, driver, &pointer), what);
  return properties;
}

} // namespace hydrodae::io
