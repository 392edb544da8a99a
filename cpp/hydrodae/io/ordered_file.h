#pragma once
/// A file on disk that is a whole HDF5 file at every moment, whenever the process that writes it is
/// killed and whenever the disk is full.
///
/// HDF5 writes metadata as it evicts and flushes them, in an order of its own: a process that dies
/// between two writes leaves pointers to what is not there. Here an HDF5 file driver keeps
/// metadata in memory until `commit`, which brings them to disk in an order in which each prefix is
/// a readable file. First come blocks that nothing on disk points to yet, and second the superblock
/// with the new end of file. Third come changed nodes of indices, parents before children. Changed
/// object headers, which hold the sizes of datasets, are the end: from the last to the first, so
/// that those of the file's root group and first dataset come last. Raw data go straight to disk:
/// they lie beyond what sizes on disk reach.
///
/// This relies on nothing being freed and used again: datasets only grow, and attributes are
/// added or overwritten by values of the same size.

#include <hdf5.h>

#include <functional>
#include <map>
#include <string>
#include <unordered_set>
#include <vector>

#include "hydrodae/io/hdf5.h"

namespace hydrodae::io {

class OrderedFile {
public:
  /// `observer` is called before every write to the disk.
  explicit OrderedFile(std::function<void()> observer) : observer_(std::move(observer)) {}
  OrderedFile(const OrderedFile&) = delete;
  OrderedFile& operator=(const OrderedFile&) = delete;

  /// File access properties for H5Fcreate and H5Fopen; this object must outlive the HDF5 file.
  hdf5::Handle access_properties();

  /// Sets the file on disk: `descriptor` is open for reading and writing and belongs to the caller.
  /// Before, everything is in memory.
  void attach(int descriptor) { descriptor_ = descriptor; }

  /// Writes the data of H5Fflush or H5Fclose to disk.
  void commit();

  /// Reason why nothing more is written ("No space left on device"); empty without failure. HDF5
  /// itself never sees a failure, because it cannot close a file that it cannot write.
  const std::string& failure() const { return failure_; }

  /// After a failure: gives back the space behind the last commit, and forgets the failure and all
  /// that is not on disk. The HDF5 file must be closed.
  void recover();

  // Functions that HDF5 calls through the driver.
  void read(haddr_t address, std::size_t size, unsigned char* out) const;
  void write(H5FD_mem_t type, haddr_t address, std::size_t size, const unsigned char* data);
  haddr_t end_of_file() const;
  haddr_t end_of_space() const { return end_of_space_; }
  void set_end_of_space(haddr_t address) { end_of_space_ = address; }

private:
  struct Block {
    H5FD_mem_t type;
    std::vector<unsigned char> bytes;
  };
  using Blocks = std::map<haddr_t, Block>;

  void put(haddr_t address, const unsigned char* data, std::size_t size);
  void put(const Blocks::value_type& block);
  bool is_on_disk(haddr_t address) const {
    return address < recovered_ || on_disk_.contains(address);
  }
  void resize();
  std::vector<const Blocks::value_type*> changed_blocks() const;

  std::function<void()> observer_;
  int descriptor_ = -1;
  Blocks pending_;                      ///< blocks by address
  std::size_t longest_ = 0;             ///< length of the longest block so far
  std::unordered_set<haddr_t> on_disk_; ///< addresses of metadata that were committed
  haddr_t end_of_space_ = 0;            ///< end of the space that HDF5 has allocated
  haddr_t committed_ = 0;               ///< end of the space by the superblock on disk
  haddr_t recovered_ = 0;               ///< end of the space on disk when it was reopened
  haddr_t size_ = 0;                    ///< size of the file on disk
  std::string failure_;
};

} // namespace hydrodae::io
