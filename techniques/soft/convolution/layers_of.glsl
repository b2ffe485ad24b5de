// The layers that surfaces and their polygons are drawn into, a bit each.
struct Surface {
    uint firstPolygon;  // of its own, in layersOfPolygon
    uint layers;        // that hold any of them
};
layout(std430, binding = 4) readonly buffer Surfaces { Surface surfaces[]; };  // by id
layout(std430, binding = 5) readonly buffer Polygons { uint layersOfPolygon[]; };
