#include "vulkan/kernel.h"

#include <algorithm>
#include <utility>

#include "core/text.h"

namespace scarf::vulkan {
namespace {

VkDescriptorType type_of(View view, const Limits& limits) {
  if (!limits.texel_views) return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
  switch (view) {
    case View::vectors:
    case View::words:
      return VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
    case View::image:
      return VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER;
    case View::storage:
      break;
  }
  return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

Result<VkBufferView> create_view(const Device& device, const Buffer& buffer, View view) {
  VkBufferViewCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO;
  info.buffer = buffer.handle();
  info.format = view == View::vectors ? VK_FORMAT_R32G32B32A32_UINT : VK_FORMAT_R32_UINT;
  info.range = buffer.bound_bytes();
  VkBufferView handle = VK_NULL_HANDLE;
  const VkResult result = device.calls().CreateBufferView(device.handle(), &info, nullptr, &handle);
  if (auto r = device.check(result, "CreateBufferView"); !r) return r.error();
  return handle;
}

}  // namespace

Result<Kernel> Kernel::create(const Device& device, const char* name, const Shader& shader,
                              const Bindings& bindings, uint32_t push_bytes,
                              std::span<const uint32_t> constants, bool whole_subgroups) {
  const Table& calls = device.calls();
  Kernel k;
  k.device_ = &device;
  k.bindings_ = bindings;

  std::vector<VkDescriptorSetLayoutBinding> slots(bindings.count());
  for (uint32_t i = 0; i < bindings.count(); ++i) {
    slots[i] = {i, type_of(bindings[i], device.limits()), 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
  }
  VkDescriptorSetLayoutCreateInfo set_info{};
  set_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  set_info.bindingCount = bindings.count();
  set_info.pBindings = slots.data();
  if (auto r =
          device.check(calls.CreateDescriptorSetLayout(device.handle(), &set_info, nullptr, &k.set_layout_),
                       "CreateDescriptorSetLayout");
      !r) {
    return r.error();
  }
  const VkPushConstantRange range = {VK_SHADER_STAGE_COMPUTE_BIT, 0, push_bytes};
  VkPipelineLayoutCreateInfo layout_info{};
  layout_info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  layout_info.setLayoutCount = 1;
  layout_info.pSetLayouts = &k.set_layout_;
  layout_info.pushConstantRangeCount = 1;
  layout_info.pPushConstantRanges = &range;
  if (auto r = device.check(calls.CreatePipelineLayout(device.handle(), &layout_info, nullptr, &k.layout_),
                            "CreatePipelineLayout");
      !r) {
    return r.error();
  }

  std::vector<VkSpecializationMapEntry> entries(constants.size());
  for (uint32_t i = 0; i < constants.size(); ++i) entries[i] = {i, i * 4, 4};
  // Nothing owns the module, so from here until it is destroyed nothing may throw.
  VkShaderModuleCreateInfo module_info{};
  module_info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  const std::span<const uint32_t> spirv = device.limits().texel_views ? shader.texels : shader.storage;
  module_info.codeSize = spirv.size_bytes();
  module_info.pCode = spirv.data();
  VkShaderModule module = VK_NULL_HANDLE;
  if (auto r = device.check(calls.CreateShaderModule(device.handle(), &module_info, nullptr, &module),
                            "CreateShaderModule");
      !r) {
    return r.error();
  }
  const VkSpecializationInfo specialization = {static_cast<uint32_t>(entries.size()), entries.data(),
                                               constants.size_bytes(), constants.data()};
  VkPipelineShaderStageRequiredSubgroupSizeCreateInfo subgroup{};
  subgroup.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_REQUIRED_SUBGROUP_SIZE_CREATE_INFO;
  subgroup.requiredSubgroupSize = device.limits().subgroup_size;
  VkComputePipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  if (whole_subgroups) {
    // Where there is but one size, asking for it may not be allowed.
    if (device.limits().requires_subgroup_size) info.stage.pNext = &subgroup;
    if (device.limits().full_subgroups)
      info.stage.flags = VK_PIPELINE_SHADER_STAGE_CREATE_REQUIRE_FULL_SUBGROUPS_BIT;
  }
  info.stage.module = module;
  info.stage.pName = "main";
  info.stage.pSpecializationInfo = &specialization;
  info.layout = k.layout_;
  const VkResult result =
      calls.CreateComputePipelines(device.handle(), device.pipeline_cache(), 1, &info, nullptr, &k.pipeline_);
  calls.DestroyShaderModule(device.handle(), module, nullptr);
  if (auto r = device.check(result, "CreateComputePipelines"); !r) {
    return Error{r.error().code, text("shader ", name, ": ", r.error().message)};
  }
  return k;
}

Kernel::~Kernel() {
  if (device_ == nullptr || device_->forked()) return;
  const Table& calls = device_->calls();
  if (pipeline_ != VK_NULL_HANDLE) calls.DestroyPipeline(device_->handle(), pipeline_, nullptr);
  if (layout_ != VK_NULL_HANDLE) calls.DestroyPipelineLayout(device_->handle(), layout_, nullptr);
  if (set_layout_ != VK_NULL_HANDLE)
    calls.DestroyDescriptorSetLayout(device_->handle(), set_layout_, nullptr);
}

void Kernel::swap(Kernel& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(bindings_, other.bindings_);
  std::swap(set_layout_, other.set_layout_);
  std::swap(layout_, other.layout_);
  std::swap(pipeline_, other.pipeline_);
}

Result<BoundKernel> BoundKernel::create(const Device& device, const Kernel& kernel,
                                        std::initializer_list<const Buffer*> buffers) {
  const Table& calls = device.calls();
  BoundKernel b;
  b.device_ = &device;
  b.kernel_ = &kernel;
  const auto count = static_cast<uint32_t>(buffers.size());
  // At most so many of each; a size of zero is not legal.
  const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, count},
                                        {VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, count},
                                        {VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER, count}};
  VkDescriptorPoolCreateInfo pool_info{};
  pool_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  pool_info.maxSets = 1;
  pool_info.poolSizeCount = 3;
  pool_info.pPoolSizes = sizes;
  if (auto r = device.check(calls.CreateDescriptorPool(device.handle(), &pool_info, nullptr, &b.pool_),
                            "CreateDescriptorPool");
      !r) {
    return r.error();
  }
  const VkDescriptorSetLayout layout = kernel.set_layout();
  VkDescriptorSetAllocateInfo set_info{};
  set_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  set_info.descriptorPool = b.pool_;
  set_info.descriptorSetCount = 1;
  set_info.pSetLayouts = &layout;
  if (auto r = device.check(calls.AllocateDescriptorSets(device.handle(), &set_info, &b.set_),
                            "AllocateDescriptorSets");
      !r) {
    return r.error();
  }
  std::vector<VkDescriptorBufferInfo> infos;
  std::vector<VkWriteDescriptorSet> writes;
  infos.reserve(count);  // the writes point into both
  b.views_.reserve(count);
  for (const Buffer* buffer : buffers) {
    infos.push_back({buffer->handle(), 0, buffer->bound_bytes()});
    VkWriteDescriptorSet write{};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = b.set_;
    write.dstBinding = static_cast<uint32_t>(writes.size());
    write.descriptorCount = 1;
    const View view = kernel.bindings()[write.dstBinding];
    write.descriptorType = type_of(view, device.limits());
    write.pBufferInfo = &infos.back();
    if (write.descriptorType != VK_DESCRIPTOR_TYPE_STORAGE_BUFFER) {
      auto handle = create_view(device, *buffer, view);
      if (!handle) return handle.error();
      b.views_.push_back(*handle);
      write.pTexelBufferView = &b.views_.back();
    }
    writes.push_back(write);
  }
  calls.UpdateDescriptorSets(device.handle(), count, writes.data(), 0, nullptr);
  return b;
}

void BoundKernel::rebind(uint32_t binding, const Buffer& buffer) {
  const VkDescriptorBufferInfo info = {buffer.handle(), 0, buffer.bound_bytes()};
  VkWriteDescriptorSet write{};
  write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
  write.dstSet = set_;
  write.dstBinding = binding;
  write.descriptorCount = 1;
  write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
  write.pBufferInfo = &info;
  device_->calls().UpdateDescriptorSets(device_->handle(), 1, &write, 0, nullptr);
}

BoundKernel::~BoundKernel() {
  if (device_ == nullptr || device_->forked()) return;
  if (pool_ != VK_NULL_HANDLE) device_->calls().DestroyDescriptorPool(device_->handle(), pool_, nullptr);
  for (VkBufferView view : views_) device_->calls().DestroyBufferView(device_->handle(), view, nullptr);
}

void BoundKernel::swap(BoundKernel& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(kernel_, other.kernel_);
  std::swap(pool_, other.pool_);
  std::swap(set_, other.set_);
  std::swap(views_, other.views_);
}

}  // namespace scarf::vulkan
