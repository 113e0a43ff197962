// The walk through the queue of one block, kept in memory so that it can take several dispatches. All arithmetic is in
// double precision, in the order of the definition; `precise` keeps the compiler from fusing it.
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_explicit_arithmetic_types_float64 : require

struct Walk {
  double activity;
  double converged;  // 0: never stop early
  uint first;        // place of the queue's oldest event in the sorted log
  uint count;        // events in the queue
  uint left;         // steps that are left
  uint passed;       // events passed; forward: 1 once the backward pass is prepared
};

layout(std430, binding = 0) readonly buffer Sorted { uvec4 sorted[]; };
layout(std430, binding = 1) buffer Walks { Walk walks[]; };
layout(push_constant) uniform Push { AaePush pushed; };
AaePush push = pushed;

int64_t time_of(uint i) { return packInt2x32(ivec2(sorted[i].xy)); }

uint pixel_of(uint i) {
  const uint xy = sorted[i].z;
  return (xy >> 16) * push.width + (xy & 0xFFFF);
}

double seconds(int64_t microseconds) {
  precise double s = double(microseconds) * 1e-6lf;
  return s;
}

// The activity after an event that came `distance` seconds from the one before.
double next_activity(double activity, double distance) {
  precise double damping = 1.0lf + activity * distance;
  precise double next = activity / damping + 1.0lf;
  return next;
}
