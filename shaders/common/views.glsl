// Buffers that a stage reads word by word, or reads and writes (an image). Drivers that read words faster through texel
// buffers are given those, the others storage buffers, which may be larger; see View in src/vulkan/kernel.h. Every stage
// is compiled for both.
// WORDS_VIEW: one word at a time; VECTORS_VIEW: four; IMAGE_VIEW: one, also written. `Block` names a block of its own.
#ifndef VIEWS_GLSL
#define VIEWS_GLSL
#ifdef SCARF_TEXEL_VIEWS
#define WORDS_VIEW(slot, Block, name) layout(binding = slot) uniform usamplerBuffer name;
#define VECTORS_VIEW(slot, Block, name) layout(binding = slot) uniform usamplerBuffer name;
#define IMAGE_VIEW(slot, Block, name) layout(binding = slot, r32ui) uniform uimageBuffer name;
#define COHERENT_IMAGE_VIEW(slot, Block, name) layout(binding = slot, r32ui) coherent uniform uimageBuffer name;
#define VIEW_WORD(name, index) texelFetch(name, int(index)).x
#define VIEW_VECTOR(name, index) texelFetch(name, int(index))
#define IMAGE_WORD(name, index) imageLoad(name, int(index)).x
#define SET_IMAGE_WORD(name, index, word) imageStore(name, int(index), uvec4(word))
#else
#define WORDS_VIEW(slot, Block, name) layout(std430, binding = slot) readonly buffer Block { uint name[]; };
#define VECTORS_VIEW(slot, Block, name) layout(std430, binding = slot) readonly buffer Block { uvec4 name[]; };
#define IMAGE_VIEW(slot, Block, name) layout(std430, binding = slot) buffer Block { uint name[]; };
#define COHERENT_IMAGE_VIEW(slot, Block, name) layout(std430, binding = slot) coherent buffer Block { uint name[]; };
#define VIEW_WORD(name, index) name[index]
#define VIEW_VECTOR(name, index) name[index]
#define IMAGE_WORD(name, index) name[index]
#define SET_IMAGE_WORD(name, index, word) name[index] = word
#endif
#endif
