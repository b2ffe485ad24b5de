// Numbers the invocations of a compute shader run by Program::dispatch from 0; the last group may run past the end.
layout(local_size_x = 64) in;

uint invocation() {
    return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
}
