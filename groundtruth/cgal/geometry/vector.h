// Vectors over any number type: doubles, intervals, rationals, rings. Free of CGAL.
#pragma once

#include <array>
#include <glm/vec3.hpp>

namespace shadowbench::groundtruth::geometry {

template <typename Number>
struct Vector {
    Number x, y, z;

    const Number& operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }

    friend Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Vector operator-(const Vector& a) { return {-a.x, -a.y, -a.z}; }
    friend Vector operator*(const Number& s, const Vector& v) { return {s * v.x, s * v.y, s * v.z}; }
};

template <typename Number>
Vector<Number> vector(const glm::dvec3& v) {
    return {Number(v.x), Number(v.y), Number(v.z)};
}

template <typename Number>
Vector<Number> cross(const Vector<Number>& a, const Vector<Number>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <typename Number>
Number dot(const Vector<Number>& a, const Vector<Number>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// (b − a) × (c − a).
template <typename Number>
Vector<Number> normal(const std::array<glm::dvec3, 3>& triangle) {
    const Vector<Number> a = vector<Number>(triangle[0]);
    return cross(vector<Number>(triangle[1]) - a, vector<Number>(triangle[2]) - a);
}

} // namespace shadowbench::groundtruth::geometry
