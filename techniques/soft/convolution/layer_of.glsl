// The layer that a surface's placement is drawn into; 32: none.
layout(std430, binding = 4) readonly buffer LayerOf { uint layerOf[]; };  // by surface id
