// The brightness of a pixel of AED-SAE, 0 to 1, in double precision.
#include "aed_sae/aed_sae_state.glsl"
layout(std430, binding = 0) readonly buffer StateBuffer { AedState state; };
layout(std430, binding = 1) readonly buffer LastTimes { int64_t last_times[]; };
layout(std430, binding = 2) readonly buffer Counts { uint listed, dense; };  // events in the list; pixels above the threshold
layout(std430, binding = 3) writeonly buffer Picture { uint picture[]; };
layout(push_constant) uniform Push { AedImagePush pushed; };
AedImagePush push = pushed;

// exp(-y) for y >= 0, to some units in the last place: shaders have no exp in double precision.
double exp_minus(double y) {
  if (!(y < 700.0lf)) return 0.0lf;
  const uint n = uint(y * 1.4426950408889634lf + 0.5lf);
  // The logarithm of 2 in two parts, of which the first has zeros behind it, so that its multiples are exact.
  const double r = (double(n) * 0.69314718036912382lf - y) + double(n) * 1.9082149292705877e-10lf;
  // The series of exp; |r| <= 0.35.
  double sum = 1.0lf + r / 14.0lf;
  sum = 1.0lf + r / 13.0lf * sum;
  sum = 1.0lf + r / 12.0lf * sum;
  sum = 1.0lf + r / 11.0lf * sum;
  sum = 1.0lf + r / 10.0lf * sum;
  sum = 1.0lf + r / 9.0lf * sum;
  sum = 1.0lf + r / 8.0lf * sum;
  sum = 1.0lf + r / 7.0lf * sum;
  sum = 1.0lf + r / 6.0lf * sum;
  sum = 1.0lf + r / 5.0lf * sum;
  sum = 1.0lf + r / 4.0lf * sum;
  sum = 1.0lf + r / 3.0lf * sum;
  sum = 1.0lf + r / 2.0lf * sum;
  sum = 1.0lf + r * sum;
  return sum * packDouble2x32(uvec2(0, (1023 - n) << 20));  // 2^-n
}

double value_of(uint pixel) {
  const int64_t last = last_times[pixel];
  if (last == kNeverFired || listed == 0) return 0.0lf;
  const uint64_t age = last < state.t_max ? uint64_t(state.t_max) - uint64_t(last) : uint64_t(0);
  if (age == 0) return 1.0lf;
  if (dense == 0) return 0.0lf;
  const double decay = packDouble2x32(uvec2(push.scale_low, push.scale_high)) * double(dense) /
                       double(listed);
  const double z = double(age) / decay;
  const double cube = z * z * z;
  return exp_minus(cube * cube);
}
