#include "io/files/write_file.h"

#include "io/files/byte_writer.h"

namespace scarf {

Result<void> write_file(const std::string& path, std::string_view content, const OutputRule& rule) {
  auto file = ByteWriter::create(path, rule);
  if (!file) return file.error();
  file->append(content);
  return file->finish();
}

}  // namespace scarf
