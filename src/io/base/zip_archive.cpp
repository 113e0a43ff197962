#include "io/base/zip_archive.h"

#include <utility>

#include "core/regular_file.h"
#include "core/text.h"
#include "io/base/format.h"

#ifdef SCARF_HAS_LIBZIP
#include <zip.h>
#endif

namespace scarf {

bool looks_like_zip(std::span<const uint8_t> bytes) {
  return starts_with(bytes, "PK\x03\x04") || starts_with(bytes, "PK\x05\x06");
}

Result<std::vector<uint8_t>> ZipArchive::read_whole(const Member& member, uint64_t limit) const {
  auto reader = read(member);
  if (!reader) return reader.error();
  std::vector<uint8_t> content;
  for (;;) {
    if (const auto filled = reader->fill(1); !filled) return filled.error();
    const auto bytes = reader->available();
    if (bytes.empty()) return content;
    if (content.size() + bytes.size() > limit) {
      return Error{ErrorCode::bad_input, text(member.name, " has more than ", limit, " bytes")};
    }
    content.insert(content.end(), bytes.begin(), bytes.end());
    reader->skip(bytes.size());
  }
}

#ifdef SCARF_HAS_LIBZIP

struct ZipArchive::Handle {
  Handle() = default;
  ~Handle() {
    if (zip != nullptr) zip_discard(zip);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  zip_t* zip = nullptr;
};

namespace {

struct CloseMember {
  void operator()(zip_file_t* file) const { zip_fclose(file); }
};

}  // namespace

Result<ZipArchive> ZipArchive::open(const std::string& path) {
  if (const auto r = require_regular(path); !r) return r.error();
  int code = 0;
  ZipArchive archive;
  const auto handle = std::make_shared<Handle>();
  archive.handle_ = handle;
  zip_t* const zip = handle->zip = zip_open(path.c_str(), ZIP_RDONLY, &code);
  if (zip == nullptr) {
    zip_error_t error;
    zip_error_init_with_code(&error, code);
    const std::string why = zip_error_strerror(&error);
    zip_error_fini(&error);
    return Error{ErrorCode::bad_input, text("the zip archive cannot be read: ", why)};
  }
  const zip_int64_t count = zip_get_num_entries(zip, 0);
  for (zip_int64_t i = 0; i < count; ++i) {
    zip_stat_t status;
    const auto index = static_cast<zip_uint64_t>(i);
    if (zip_stat_index(zip, index, 0, &status) != 0 || (status.valid & ZIP_STAT_NAME) == 0) continue;
    std::string name = status.name;
    if (name.ends_with('/')) continue;
    archive.members_.push_back(
        {std::move(name), (status.valid & ZIP_STAT_SIZE) != 0 ? status.size : 0, index});
  }
  return archive;
}

Result<ByteReader> ZipArchive::read(const Member& member) const {
  // The member goes before the archive that it is of.
  struct Open {
    std::shared_ptr<Handle> archive;
    std::unique_ptr<zip_file_t, CloseMember> file;
    std::string name;
    bool broken = false;
  };
  auto open = std::make_shared<Open>();
  open->archive = handle_;
  open->file.reset(zip_fopen_index(handle_->zip, member.index, 0));
  if (open->file == nullptr) {
    return Error{ErrorCode::bad_input, text(member.name, " in the zip archive cannot be read: ",
                                            zip_error_strerror(zip_get_error(handle_->zip)))};
  }
  open->name = member.name;
  const auto read_some = [open](std::span<uint8_t> out) -> Result<size_t> {
    if (open->broken) return size_t{0};
    const zip_int64_t count = zip_fread(open->file.get(), out.data(), out.size());
    if (count >= 0) return static_cast<size_t>(count);
    open->broken = true;
    zip_error_t* const error = zip_file_get_error(open->file.get());
    const bool unreadable = zip_error_code_zip(error) == ZIP_ER_READ;
    return Error{unreadable ? ErrorCode::io : ErrorCode::bad_input,
                 text(open->name, " in the zip archive ",
                      unreadable ? "cannot be read: " : "is broken: ", zip_error_strerror(error))};
  };
  return ByteReader(read_some, member.bytes);
}

#else

struct ZipArchive::Handle {};

Result<ZipArchive> ZipArchive::open(const std::string& /*path*/) {
  return Error{ErrorCode::bad_input,
               text("this is a zip archive, and this build of scarf has no ", kZipMissing,
                    "; install it and build again, or unpack the archive")};
}

Result<ByteReader> ZipArchive::read(const Member& member) const {
  return Error{ErrorCode::bad_input, text(member.name, " cannot be read without ", kZipMissing)};
}

#endif

}  // namespace scarf
