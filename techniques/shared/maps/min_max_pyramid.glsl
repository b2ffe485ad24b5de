// Nearest and farthest depths over the squares of a quadtree on a shadow map (shared/maps/min_max_pyramid.h), and a walk over the
// quadtree.
uniform sampler2D pyramid;
uniform int pyramidSide;  // of the map, rounded up to a power of two
uniform int mapSide;      // texels

/// Greatest and least 1 / depth of the texels of a node of level ≥ 1.
vec2 nodeRange(int layer, int level, ivec2 node) {
    int across = pyramidSide >> 1;
    ivec2 at = level > 1 ? ivec2(across, across - (pyramidSide >> (level - 1))) : ivec2(0);
    return texelFetch(pyramid, at + node + ivec2(0, layer * across), 0).rg;
}

/// Greatest 1 / depth of the whole map.
float nearestOfAll(int layer) {
    return nodeRange(layer, findMSB(pyramidSide), ivec2(0)).x;
}

/// An upper bound on 1 / depth of the texels from `low` to `high`: over at most 3 × 3 nodes that hold them. 0 if there are none.
float nearestOver(int layer, ivec2 low, ivec2 high) {
    ivec2 extent = high - low;
    int level = max(findMSB(max(extent.x, extent.y)), 1);
    ivec2 first = low >> level;
    ivec2 last = high >> level;
    float nearest = 0.0;
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) nearest = max(nearest, nodeRange(layer, level, ivec2(x, y)).x);
    return nearest;
}

/// Where a walk over a root's part of the quadtree is: nodes in Morton order, each before its children.
struct Walk {
    ivec2 root;  // first texel
    int rootLevel;
    int level;
    uint index;  // Morton code of the node's first texel within the root
};

const int highestRoot = 8;  // a root has at most 128² nodes of level 1

Walk walkFrom(ivec2 root, int rootLevel) {
    return Walk(root << rootLevel, rootLevel, rootLevel, 0u);
}

bool finished(Walk walk) {
    return walk.index >= 1u << (2 * walk.rootLevel);
}

uint evenBits(uint code) {
    code &= 0x5555u;
    code = (code | code >> 1) & 0x3333u;
    code = (code | code >> 2) & 0x0f0fu;
    return (code | code >> 4) & 0x00ffu;
}

ivec2 firstTexel(Walk walk) {
    return walk.root + ivec2(evenBits(walk.index), evenBits(walk.index >> 1));
}

/// The first child, or else what comes after the node and all below it.
Walk stepped(Walk walk, bool down) {
    if (down) {
        --walk.level;
    } else {
        walk.index += 1u << (2 * walk.level);
        walk.level = min(walk.rootLevel, findLSB(walk.index) >> 1);
    }
    return walk;
}
