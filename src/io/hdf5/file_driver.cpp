#include "io/hdf5/file_driver.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <iterator>
#include <new>
#include <system_error>
#include <utility>

#include "core/text.h"

#if H5_VERSION_GE(1, 13, 0)
#include <H5FDdevelop.h>
#endif

namespace scarf::hdf5 {

Result<std::shared_ptr<DriverFile>> DriverFile::create(const std::string& name, const std::string& shown) {
  auto made = std::make_shared<DriverFile>();
  made->task_ = "cannot write " + shown;
  made->file_ = FileDescriptor(::open(name.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (made->file_.get() < 0) {
    return Error{ErrorCode::io, text("cannot create ", shown, ": ", std::generic_category().message(errno))};
  }
  return made;
}

Result<std::shared_ptr<DriverFile>> DriverFile::open(const std::string& path) {
  auto made = std::make_shared<DriverFile>();
  made->task_ = "cannot read";
  auto file = open_regular(path);
  if (!file) return file.error();
  struct stat status {};
  if (fstat(file->get(), &status) != 0) {
    return Error{ErrorCode::io, text("cannot open: ", std::generic_category().message(errno))};
  }
  made->size_ = static_cast<uint64_t>(status.st_size);
  made->file_ = *std::move(file);
  return made;
}

Result<void> DriverFile::check() const {
  if (failure_ == 0) return {};
  return Error{failure_ == ENOMEM ? ErrorCode::out_of_memory : ErrorCode::io,
               text(task_, ": ", std::generic_category().message(failure_))};
}

Error DriverFile::error(const std::string& what) const {
  if (const auto r = check(); !r) return r.error();
  return error_of(ErrorCode::io, text(task_, ": ", what));
}

Result<void> DriverFile::finish() {
  // EINVAL: a file that is on no disk.
  if (failure_ == 0 && fsync(file_.get()) != 0 && errno != EINVAL) fail(errno);
  if (close(file_.release()) != 0) fail(errno);
  return check();
}

bool DriverFile::lock_shared() const {
  return flock(file_.get(), LOCK_SH | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

void DriverFile::write(uint64_t at, std::span<const uint8_t> bytes) {
  size_ = std::max<uint64_t>(size_, at + bytes.size());
  while (failure_ == 0 && !bytes.empty()) {
    const ssize_t count = pwrite(file_.get(), bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (count > 0) {
      bytes = bytes.subspan(static_cast<size_t>(count));
      at += static_cast<uint64_t>(count);
    } else if (count == 0 || errno != EINTR) {
      fail(count == 0 ? EIO : errno);
    }
  }
  if (!bytes.empty()) kept_.push_back({at, {bytes.begin(), bytes.end()}});
}

bool DriverFile::read(uint64_t at, std::span<uint8_t> out) {
  size_t have = 0;
  while (have < out.size()) {
    const ssize_t count =
        pread(file_.get(), out.data() + have, out.size() - have, static_cast<off_t>(at + have));
    if (count == 0) break;
    if (count > 0) {
      have += static_cast<size_t>(count);
    } else if (errno != EINTR) {
      fail(errno);
      return false;
    }
  }
  std::fill(out.begin() + static_cast<ptrdiff_t>(have), out.end(), uint8_t{0});
  for (const Kept& kept : kept_) {
    const uint64_t begin = std::max(at, kept.at);
    const uint64_t end = std::min<uint64_t>(at + out.size(), kept.at + kept.bytes.size());
    if (begin >= end) continue;
    std::copy_n(kept.bytes.begin() + static_cast<ptrdiff_t>(begin - kept.at), end - begin,
                out.begin() + static_cast<ptrdiff_t>(begin - at));
  }
  return true;
}

void DriverFile::resize(uint64_t size) {
  if (size != size_ && failure_ == 0 && ftruncate(file_.get(), static_cast<off_t>(size)) != 0) fail(errno);
  size_ = size;
}

void DriverFile::fail(int number) {
  if (failure_ == 0) failure_ = number;
}

namespace {

// What libhdf5 holds of an open file.
struct OpenFile : H5FD_t {
  std::shared_ptr<DriverFile> file;
  haddr_t end_of_space = 0;
};

OpenFile& of(H5FD_t* file) {
  return *static_cast<OpenFile*>(file);
}
const OpenFile& of(const H5FD_t* file) {
  return *static_cast<const OpenFile*>(file);
}

// What is in the properties: libhdf5 copies it as bytes.
struct Properties {
  const std::shared_ptr<DriverFile>* file;
};

H5FD_t* open_file(const char*, unsigned, hid_t access, haddr_t) {
  const auto* const properties = static_cast<const Properties*>(H5Pget_driver_info(access));
  if (properties == nullptr) return nullptr;
  auto* const file = new (std::nothrow) OpenFile{};
  if (file != nullptr) {
    file->file = *properties->file;
  } else {
    (*properties->file)->fail(ENOMEM);
  }
  return file;
}

herr_t close_file(H5FD_t* file) {
  delete &of(file);
  return 0;
}

// As libhdf5's own driver: it decides how space is given out, and so the bytes of the file.
herr_t query(const H5FD_t*, unsigned long* flags) {
  if (flags == nullptr) return 0;
  *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
           H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

haddr_t get_end_of_space(const H5FD_t* file, H5FD_mem_t) {
  return of(file).end_of_space;
}

herr_t set_end_of_space(H5FD_t* file, H5FD_mem_t, haddr_t end) {
  of(file).end_of_space = end;
  return 0;
}

haddr_t get_end_of_file(const H5FD_t* file, H5FD_mem_t) {
  return of(file).file->size();
}

// For H5Fget_vfd_handle, of which read_failure() is told.
herr_t get_handle(H5FD_t* file, hid_t, void** handle) {
  *handle = of(file).file.get();
  return 0;
}

herr_t read(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, size_t size, void* out) {
  return of(file).file->read(at, {static_cast<uint8_t*>(out), size}) ? 0 : -1;
}

herr_t write(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, size_t size, const void* bytes) {
  try {
    of(file).file->write(at, {static_cast<const uint8_t*>(bytes), size});
  } catch (const std::bad_alloc&) {  // the disk has failed before, or nothing would be kept in memory
  }
  return 0;
}

herr_t truncate(H5FD_t* file, hid_t, hbool_t) {
  of(file).file->resize(of(file).end_of_space);
  return 0;
}

// Files that are read: not while another program writes them by libhdf5, which locks them too. A file that is
// written here is ours alone.
herr_t lock(H5FD_t* file, hbool_t writes) {
  return writes || of(file).file->lock_shared() ? 0 : -1;
}

herr_t unlock(H5FD_t*) {
  return 0;  // with its descriptor
}

hid_t register_driver() {
  static const H5FD_class_t kDriver = [] {
    constexpr H5FD_mem_t kSpaces[] = H5FD_FLMAP_DICHOTOMY;
    H5FD_class_t driver{};
#ifdef H5FD_CLASS_VERSION
    driver.version = H5FD_CLASS_VERSION;
    driver.value = 600;  // of those that are nobody's
#endif
    driver.name = "scarf";
    driver.maxaddr = (haddr_t{1} << 63) - 1;
    driver.fc_degree = H5F_CLOSE_WEAK;
    driver.fapl_size = sizeof(Properties);
    driver.open = open_file;
    driver.close = close_file;
    driver.query = query;
    driver.get_eoa = get_end_of_space;
    driver.set_eoa = set_end_of_space;
    driver.get_eof = get_end_of_file;
    driver.get_handle = get_handle;
    driver.read = read;
    driver.write = write;
    driver.truncate = truncate;
    driver.lock = lock;
    driver.unlock = unlock;
    std::copy(std::begin(kSpaces), std::end(kSpaces), std::begin(driver.fl_map));
    return driver;
  }();
  return H5FDregister(&kDriver);
}

}  // namespace

Handle driven_by(const std::shared_ptr<DriverFile>& file) {
  const Turn turn;
  static hid_t driver = H5I_INVALID_HID;
  if (H5Iget_type(driver) != H5I_VFL) driver = register_driver();  // again, if the program has closed libhdf5
  Handle access(H5Pcreate(H5P_FILE_ACCESS));
  const Properties properties{&file};
  if (H5Pset_driver(access.id(), driver, &properties) < 0) return Handle();
  return access;
}

}  // namespace scarf::hdf5
