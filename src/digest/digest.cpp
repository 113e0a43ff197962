#include "scarf/digest/digest.h"

#include <openssl/evp.h>

#include "core/event_bytes.h"

namespace scarf {

struct Digest::Impl {
  EVP_MD_CTX* context = EVP_MD_CTX_new();

  Impl() { start(); }
  ~Impl() { EVP_MD_CTX_free(context); }
  void start() { EVP_DigestInit_ex(context, EVP_sha256(), nullptr); }
};

Digest::Digest() : impl_(std::make_unique<Impl>()) {}
Digest::~Digest() = default;
Digest::Digest(Digest&&) noexcept = default;
Digest& Digest::operator=(Digest&&) noexcept = default;

void Digest::add(std::span<const uint8_t> bytes) {
  EVP_DigestUpdate(impl_->context, bytes.data(), bytes.size());
}

std::string Digest::hex() {
  uint8_t bytes[EVP_MAX_MD_SIZE];
  unsigned size = 0;
  EVP_DigestFinal_ex(impl_->context, bytes, &size);
  impl_->start();
  std::string out;
  for (unsigned i = 0; i < size; ++i) {
    out += "0123456789abcdef"[bytes[i] >> 4];
    out += "0123456789abcdef"[bytes[i] & 15];
  }
  return out;
}

void EventDigest::add(const Event& event) {
  append_event(buffer_, event);
  if (buffer_.size() >= 64 * 1024) flush();
}

void EventDigest::flush() {
  digest_.add(buffer_);
  buffer_.clear();
}

std::string EventDigest::hex() {
  flush();
  return digest_.hex();
}

std::string state_digest(const Snapshot& snapshot) {
  Digest digest;
  for (size_t patch = 0; patch < snapshot.totals.size(); ++patch) digest.add(state_bytes(snapshot, patch));
  return digest.hex();
}

std::string image_digest(const Image<uint8_t>& image) {
  Digest digest;
  digest.add(image.pixels);
  return digest.hex();
}

}  // namespace scarf
