// Vectors over any number type: intervals, rationals.
#pragma once

#include <glm/vec3.hpp>

namespace shadowbench::groundtruth {

template <typename Number>
struct AreaVector {
    Number x, y, z;

    static AreaVector from(const glm::dvec3& v) { return {Number(v.x), Number(v.y), Number(v.z)}; }

    friend AreaVector operator-(const AreaVector& a, const AreaVector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend AreaVector operator+(const AreaVector& a, const AreaVector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend AreaVector operator-(const AreaVector& a) { return {-a.x, -a.y, -a.z}; }
    friend AreaVector operator*(const Number& s, const AreaVector& v) { return {s * v.x, s * v.y, s * v.z}; }
};

template <typename Number>
AreaVector<Number> cross(const AreaVector<Number>& a, const AreaVector<Number>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <typename Number>
Number dot(const AreaVector<Number>& a, const AreaVector<Number>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

} // namespace shadowbench::groundtruth
