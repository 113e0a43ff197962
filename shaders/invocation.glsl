// Index of an invocation over a dispatch of up to two dimensions of one-dimensional workgroups.
// Include it after the local size is declared: before, gl_WorkGroupSize is silently 1.
uint linear_workgroup() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }
uint linear_index() { return linear_workgroup() * gl_WorkGroupSize.x + gl_LocalInvocationID.x; }
