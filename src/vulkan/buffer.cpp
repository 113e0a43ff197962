#include "vulkan/buffer.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <utility>

#include "core/text.h"

namespace scarf::vulkan {
namespace {

constexpr uint64_t kGuardBytes = 256;
constexpr uint8_t kPoison = 0xA5;
constexpr uint64_t kAlignment = 16;

constexpr VkMemoryPropertyFlags kLocal = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
constexpr VkMemoryPropertyFlags kHost =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
constexpr VkMemoryPropertyFlags kCached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;

std::optional<uint32_t> memory_type(const VkPhysicalDeviceMemoryProperties& memory, uint32_t allowed,
                                    MemoryUse use) {
  // Best first. The host reads upload memory too (it checks events in place), so cached memory is preferred.
  const std::initializer_list<VkMemoryPropertyFlags> device_wishes = {kLocal, 0};
  const std::initializer_list<VkMemoryPropertyFlags> host_wishes = {kHost | kCached | kLocal, kHost | kCached,
                                                                    kHost};
  for (VkMemoryPropertyFlags wish : use == MemoryUse::device ? device_wishes : host_wishes) {
    for (uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
      if ((allowed >> i & 1) != 0 && (memory.memoryTypes[i].propertyFlags & wish) == wish) return i;
    }
  }
  return std::nullopt;
}

}  // namespace

Result<Buffer> Buffer::create(const Device& device, const char* name, uint64_t bytes, MemoryUse use) {
  Buffer b;
  b.device_ = &device;
  b.name_ = name;
  b.size_ = (std::max<uint64_t>(bytes, 1) + kAlignment - 1) / kAlignment * kAlignment;
  if (b.size_ > device.limits().storage_range) {
    return Error{ErrorCode::out_of_memory,
                 text(name, " needs ", b.size_, " bytes, but a buffer of device ", device.info().name,
                      " holds at most ", device.limits().storage_range,
                      "; use a smaller sensor, capacity or grid, or another device")};
  }
  const auto failed = [&](const Error& e) {
    return Error{e.code, text(name, " of ", b.size_, " bytes: ", e.message)};
  };
  const Table& calls = device.calls();
  const bool poisoned = device.options().poison_memory;
  const uint32_t families[] = {const_cast<Device&>(device).compute().family(),
                               const_cast<Device&>(device).transfer().family()};
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = b.size_ + (poisoned ? kGuardBytes : 0);
  info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
               VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
               VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  if (families[0] != families[1]) {
    info.sharingMode = VK_SHARING_MODE_CONCURRENT;
    info.queueFamilyIndexCount = 2;
    info.pQueueFamilyIndices = families;
  }
  if (auto r = device.check(calls.CreateBuffer(device.handle(), &info, nullptr, &b.buffer_), "CreateBuffer");
      !r) {
    return failed(r.error());
  }
  VkMemoryRequirements needs{};
  calls.GetBufferMemoryRequirements(device.handle(), b.buffer_, &needs);
  const auto type = memory_type(device.memory(), needs.memoryTypeBits, use);
  if (!type) return Error{ErrorCode::device, text(name, ": the device has no suitable memory type")};
  const VkMemoryPropertyFlags flags = device.memory().memoryTypes[*type].propertyFlags;
  b.device_local_ = (flags & kLocal) != 0;
  VkMemoryAllocateInfo allocation{};
  allocation.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  allocation.allocationSize = needs.size;
  allocation.memoryTypeIndex = *type;
  if (auto r = device.check(calls.AllocateMemory(device.handle(), &allocation, nullptr, &b.memory_),
                            "AllocateMemory");
      !r) {
    return failed(r.error());
  }
  if (auto r =
          device.check(calls.BindBufferMemory(device.handle(), b.buffer_, b.memory_, 0), "BindBufferMemory");
      !r) {
    return failed(r.error());
  }
  if (use != MemoryUse::device || (poisoned && (flags & kHost) == kHost)) {
    void* address = nullptr;
    if (auto r = device.check(calls.MapMemory(device.handle(), b.memory_, 0, VK_WHOLE_SIZE, 0, &address),
                              "MapMemory");
        !r) {
      return failed(r.error());
    }
    if (use != MemoryUse::device) b.mapped_ = address;
    if (poisoned) {
      b.guarded_ = static_cast<uint8_t*>(address);
      b.poison();
    }
  }
  return b;
}

Buffer::~Buffer() {
  if (device_ == nullptr || device_->forked()) return;
  const Table& calls = device_->calls();
  if (!guards_intact()) device_->add_message("a shader wrote beyond the end of ", name_);
  if (buffer_ != VK_NULL_HANDLE) calls.DestroyBuffer(device_->handle(), buffer_, nullptr);
  if (memory_ != VK_NULL_HANDLE) calls.FreeMemory(device_->handle(), memory_, nullptr);
}

uint64_t Buffer::bound_bytes() const {
  if (guarded_ == nullptr) return size_;
  return std::min(size_ + kGuardBytes, device_->limits().storage_range);
}

void Buffer::poison() {
  std::memset(guarded_, kPoison, size_ + kGuardBytes);
}

bool Buffer::guards_intact() const {
  for (uint64_t i = size_; guarded_ != nullptr && i < size_ + kGuardBytes; ++i) {
    if (guarded_[i] != kPoison) return false;
  }
  return true;
}

void Buffer::swap(Buffer& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(name_, other.name_);
  std::swap(buffer_, other.buffer_);
  std::swap(memory_, other.memory_);
  std::swap(size_, other.size_);
  std::swap(mapped_, other.mapped_);
  std::swap(guarded_, other.guarded_);
  std::swap(device_local_, other.device_local_);
}

}  // namespace scarf::vulkan
