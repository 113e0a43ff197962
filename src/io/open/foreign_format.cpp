#include "io/open/foreign_format.h"

#include <algorithm>
#include <filesystem>
#include <iterator>

namespace scarf {
namespace {

using namespace std::string_view_literals;

// When a file of these bytes stands in for a recording.
enum class Stands {
  never,
  always,
  unless_named_other,  // unless the extension is one of files without events
  if_named_recording,  // if the extension is a recording's
};

struct Magic {
  std::string_view bytes;
  std::string_view advice;
  Stands stands = Stands::never;
};

constexpr std::string_view kPointer =
    "this is a pointer of Git LFS, not the file itself: fetch it with `git lfs pull`"sv;
constexpr std::string_view kPage =
    "this is a page of the web, not the file itself: open it to see why, and download the file again"sv;

constexpr Magic kMagics[] = {
    {"\x1f\x8b"sv, "looks like gzip: unpack it first"},
    {"BZh"sv, "looks like bzip2: unpack it first"},
    {"\xfd\x37zXZ\0"sv, "looks like xz: unpack it first"},
    {"\x28\xb5\x2f\xfd"sv, "looks like Zstandard: unpack it first"},
    {"7z\xbc\xaf\x27\x1c"sv, "looks like a 7z archive: unpack it first"},
    {"#!AER-DAT1"sv, {}},
    {"#!AER-DAT2"sv, {}},
    {"#!AER-DAT3.1"sv, {}},
    {"#!AER-DAT4.0"sv, {}},
    {"#!AER-DAT"sv,
     "this is AEDAT of another version than 1, 2, 3.1 and 4.0, which scarf does not read: convert it to "
     "AEDAT4 "
     "with iniVation's DV, or to text",
     Stands::always},
    {"\x89PNG"sv, "looks like a PNG image, not events"},
    {"\xff\xd8\xff"sv, "looks like a JPEG image, not events"},
    {"version https://git-lfs.github.com/spec/"sv, kPointer, Stands::unless_named_other},
    {"version https://hawser.github.com/spec/"sv, kPointer, Stands::unless_named_other},
    {"/annex/objects/"sv,
     "this is a pointer of git-annex, not the file itself: fetch it with `git annex get`"sv,
     Stands::unless_named_other},
};

// Of pages, in small letters; before them may be blanks.
constexpr std::string_view kPages[] = {"<!doctype"sv, "<html"sv, "<head"sv, "<?xml"sv, "<error"sv};

constexpr std::string_view kRecordingNames[] = {
    ".raw", ".dat",  ".aedat4", ".aedat", ".es",  ".h5",  ".hdf5", ".hdf", ".npy",  ".npz",  ".bag",
    ".db3", ".mcap", ".zip",    ".csv",   ".bin", ".log", ".txt",  ".evt", ".evt2", ".evt3",
};
constexpr std::string_view kOnlyRecordings[] = {".aedat4", ".aedat", ".bag", ".mcap", ".es"};
// An empty one may be meant: labels, logs.
constexpr std::string_view kTextNames[] = {".csv", ".txt", ".log"};

constexpr std::string_view kOtherNames[] = {
    ".png", ".jpg", ".jpeg", ".bmp",   ".tif", ".tiff", ".gif",  ".pgm",  ".ppm",  ".exr",  ".pdf",
    ".md",  ".rst", ".py",   ".ipynb", ".m",   ".mat",  ".yaml", ".yml",  ".xml",  ".json", ".html",
    ".htm", ".mp4", ".avi",  ".mov",   ".mkv", ".pt",   ".pth",  ".ckpt", ".onnx", ".pkl",  ".ply",
    ".pcd", ".obj", ".stl",  ".gz",    ".bz2", ".xz",   ".zst",  ".7z",   ".tar",  ".tgz",
};

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

std::string extension_of(const std::string& name) {
  std::string extension = std::filesystem::path(name).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), lower);
  return extension;
}

template <class List>
bool contains(const List& list, std::string_view word) {
  return std::find(std::begin(list), std::end(list), word) != std::end(list);
}

bool stands_for_recording(Stands stands, const std::string& name) {
  switch (stands) {
    case Stands::never:
      break;
    case Stands::always:
      return true;
    case Stands::unless_named_other:
      return !contains(kOtherNames, extension_of(name));
    case Stands::if_named_recording:
      return contains(kRecordingNames, extension_of(name));
  }
  return false;
}

bool is_page(std::string_view start) {
  if (start.starts_with("\xef\xbb\xbf")) start.remove_prefix(3);
  start.remove_prefix(std::min(start.find_first_not_of(" \t\r\n"), start.size()));
  return std::any_of(std::begin(kPages), std::end(kPages), [&](std::string_view page) {
    return start.size() >= page.size() &&
           std::equal(page.begin(), page.end(), start.begin(), [](char a, char b) { return a == lower(b); });
  });
}

// Text in 16-bit characters, as some shells and editors write it.
bool is_wide_text(std::string_view start) {
  if (start.size() < 8 || !(start.starts_with("\xff\xfe") || start.starts_with("\xfe\xff"))) return false;
  const size_t zero = start[0] == '\xff' ? 1 : 0;
  for (size_t at = 2; at + 1 < std::min<size_t>(start.size(), 64); at += 2) {
    if (start[at + zero] != 0 || start[at + 1 - zero] == 0) return false;
  }
  return true;
}

}  // namespace

ForeignFile foreign_file(std::span<const uint8_t> bytes, const std::string& name) {
  const std::string_view start(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  for (const Magic& magic : kMagics) {
    if (start.starts_with(magic.bytes)) {
      return {magic.advice, stands_for_recording(magic.stands, name),
              magic.stands == Stands::unless_named_other};
    }
  }
  if (is_page(start)) return {kPage, stands_for_recording(Stands::if_named_recording, name), true};
  if (is_wide_text(start)) {
    return {"this is text in UTF-16: convert it with `iconv -f UTF-16 -t UTF-8`",
            stands_for_recording(Stands::if_named_recording, name)};
  }
  return {};
}

bool is_lost_if_empty(const std::string& name) {
  const std::string extension = extension_of(name);
  return contains(kRecordingNames, extension) && !contains(kTextNames, extension);
}

bool is_recording_by_name(const std::string& name) {
  return contains(kOnlyRecordings, extension_of(name));
}

}  // namespace scarf
