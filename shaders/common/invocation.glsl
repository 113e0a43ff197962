// Index of an invocation over a dispatch of up to two dimensions of one-dimensional workgroups.
// Include it after the local size is declared: before, gl_WorkGroupSize is silently 1.
// The last workgroup may have invocations beyond those that were asked for, and a dispatch of two dimensions whole
// workgroups (see workgroup_grid() in src/vulkan/commands.h): every stage has to leave them alone, they own nothing.
uint linear_workgroup() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }
uint linear_index() { return linear_workgroup() * gl_WorkGroupSize.x + gl_LocalInvocationID.x; }
