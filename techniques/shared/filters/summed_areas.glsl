// Where the sums of a layer lie: (side + 1)² a layer, each of the texels before a corner in x and in y; the first row and column are 0.
layout(std430, binding = 3) buffer SummedAreas { uint areas[]; };

uniform int side;  // texels of the map

uint sumIndex(int layer, ivec2 corner) {
    return uint((layer * (side + 1) + corner.y) * (side + 1) + corner.x);
}
